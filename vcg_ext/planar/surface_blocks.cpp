// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/surface_blocks.h"

#include <algorithm>

namespace dcharts {
namespace {

constexpr int kNone = -1, kShared = -2;

}  // namespace

SurfaceBlocks::SurfaceBlocks(const CollapseTask& surface, const std::vector<int>& faces, int count)
    : surface_(surface),
      faces_(faces),
      count_(count),
      place_(surface.ids.size(), -1),
      inner_(count),
      rim_(count),
      number_(surface.positions.size(), kNone) {
  std::vector<int>& block_of = number_;
  for (int b = 0; b < count; ++b)
    for (int k = Begin(b); k < Begin(b + 1); ++k) {
      place_[faces[k]] = k;
      for (int h = 3 * faces[k]; h < 3 * faces[k] + 3; ++h) {
        int& block = block_of[surface.vertex[h]];
        block = block == kNone || block == b ? b : kShared;
      }
    }
  for (int b = 0; b < count; ++b) {
    for (int k = Begin(b); k < Begin(b + 1); ++k)
      for (int h = 3 * faces[k]; h < 3 * faces[k] + 3; ++h)
        if (block_of[surface.vertex[h]] == kShared) rim_[b].push_back(surface.vertex[h]);
    std::sort(rim_[b].begin(), rim_[b].end());
    rim_[b].erase(std::unique(rim_[b].begin(), rim_[b].end()), rim_[b].end());
  }
  for (int v = 0; v < static_cast<int>(number_.size()); ++v) {
    if (block_of[v] < 0) continue;
    std::vector<int>& inner = inner_[block_of[v]];
    number_[v] = static_cast<int>(inner.size());
    inner.push_back(v);
  }
}

double SurfaceBlocks::ShareOfInner() const {
  std::size_t inner = 0, all = 0;
  for (int b = 0; b < count_; ++b) {
    inner += inner_[b].size();
    all += inner_[b].size() + rim_[b].size();
  }
  return all > 0 ? static_cast<double>(inner) / static_cast<double>(all) : 1;
}

CollapseTask SurfaceBlocks::Task(int block) const {
  CollapseTask task;
  const std::size_t vertex_count = inner_[block].size() + rim_[block].size();
  const std::size_t face_count = static_cast<std::size_t>(Begin(block + 1) - Begin(block));
  task.positions.reserve(vertex_count);
  task.quadrics.reserve(vertex_count);
  task.freedom.reserve(vertex_count);
  task.ids.reserve(face_count);
  task.vertex.reserve(3 * face_count);
  task.opposite.reserve(3 * face_count);
  for (const std::vector<int>* vertices : {&inner_[block], &rim_[block]})
    for (int v : *vertices) {
      task.positions.push_back(surface_.positions[v]);
      task.quadrics.push_back(surface_.quadrics[v]);
      task.freedom.push_back(vertices == &rim_[block] ? static_cast<char>(kApart) : surface_.freedom[v]);
    }
  for (int k = Begin(block); k < Begin(block + 1); ++k) {
    task.ids.push_back(surface_.ids[faces_[k]]);
    for (int h = 3 * faces_[k]; h < 3 * faces_[k] + 3; ++h) {
      task.vertex.push_back(LocalVertex(block, surface_.vertex[h]));
      task.opposite.push_back(surface_.opposite[h] < 0 ? -1 : LocalHalfEdge(block, surface_.opposite[h]));
    }
  }
  return task;
}

void SurfaceBlocks::WriteBack(int block, const EdgeCollapser& done, CollapseTask& surface,
                              std::vector<int>& heir) const {
  const CollapsingMesh& mesh = done.Mesh();
  const std::vector<int>& inner = inner_[block];
  const int begin = Begin(block), inner_count = static_cast<int>(inner.size());
  for (int k = begin; k < Begin(block + 1); ++k) {
    const int f = faces_[k], local = k - begin;
    if (!mesh.FaceLives(local)) {
      heir[f] = faces_[begin + done.Heir(local)];
      for (int i = 0; i < 3; ++i) surface.vertex[3 * f + i] = -1;
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      const int v = mesh.Vertex(3 * local + i), o = mesh.Opposite(3 * local + i), h = 3 * f + i;
      surface.vertex[h] = v < inner_count ? inner[v] : rim_[block][v - inner_count];
      // The edges along the rim are as they were.
      if (o >= 0)
        surface.opposite[h] = 3 * faces_[begin + o / 3] + o % 3;
      else if (surface.opposite[h] >= 0 && LocalHalfEdge(block, surface.opposite[h]) >= 0)
        surface.opposite[h] = -1;
    }
  }
  for (int v = 0; v < inner_count; ++v) surface.quadrics[inner[v]] = done.QuadricOf(v);
}

void SurfaceBlocks::AppendHistory(int block, const CollapseHistory& steps, CollapseHistory& all) const {
  const std::vector<int>& inner = inner_[block];
  const int inner_count = static_cast<int>(inner.size()), offset = static_cast<int>(all.rings.size());
  all.phases.back().push_back(static_cast<int>(all.steps.size()));
  for (const CollapseHistory::Step& step : steps.steps)
    all.steps.push_back({inner[step.vertex], offset + step.ring_begin, step.closed});
  for (int v : steps.rings) all.rings.push_back(v < inner_count ? inner[v] : rim_[block][v - inner_count]);
}

int SurfaceBlocks::Begin(int block) const {
  return static_cast<int>(static_cast<long long>(faces_.size()) * block / count_);
}

int SurfaceBlocks::LocalHalfEdge(int block, int half_edge) const {
  const int place = place_[half_edge / 3];
  if (place < Begin(block) || place >= Begin(block + 1)) return -1;
  return 3 * (place - Begin(block)) + half_edge % 3;
}

int SurfaceBlocks::LocalVertex(int block, int vertex) const {
  if (number_[vertex] != kShared) return number_[vertex];
  const std::vector<int>& rim = rim_[block];
  return static_cast<int>(inner_[block].size() +
                          (std::lower_bound(rim.begin(), rim.end(), vertex) - rim.begin()));
}

}  // namespace dcharts
