// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/patch_paths.h"

#include <functional>
#include <queue>
#include <utility>

namespace dcharts {

std::vector<std::vector<int>> LoopsOf(const ChartPatch& patch) {
  std::vector<std::vector<int>> loops;
  std::vector<char> done(patch.HalfEdgeCount(), 0);
  for (int start = 0; start < patch.HalfEdgeCount(); ++start) {
    if (patch.opposite[start] >= 0 || done[start]) continue;
    loops.emplace_back();
    int h = start;
    do {
      done[h] = 1;
      loops.back().push_back(h);
      h = Next(h);
      while (patch.opposite[h] >= 0) h = Next(patch.opposite[h]);
    } while (h != start);
  }
  return loops;
}

int EulerCharacteristic(const ChartPatch& patch) {
  int edges = 0;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) edges += patch.opposite[h] < h;  // -1 too
  return patch.VertexCount() - edges + static_cast<int>(patch.faces.size());
}

PatchPaths::PatchPaths(const ChartPatch& patch) : patch_(patch), on_boundary_(patch.VertexCount(), 0) {
  ring_start_.assign(patch.VertexCount() + 1, 0);
  auto each = [&](auto&& visit) {
    for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
      visit(patch.Vertex(h), h);
      if (patch.opposite[h] < 0) visit(patch.Vertex(Next(h)), h);
    }
  };
  each([&](int v, int) { ++ring_start_[v + 1]; });
  for (int v = 0; v < patch.VertexCount(); ++v) ring_start_[v + 1] += ring_start_[v];
  ring_.resize(ring_start_.back());
  std::vector<int> fill(ring_start_.begin(), ring_start_.end() - 1);
  each([&](int v, int h) { ring_[fill[v]++] = h; });
  for (int h = 0; h < patch.HalfEdgeCount(); ++h)
    if (patch.opposite[h] < 0) on_boundary_[patch.Vertex(h)] = on_boundary_[patch.Vertex(Next(h))] = 1;
}

void PatchPaths::Run(const std::vector<int>& sources, bool inside_only) {
  distance_.assign(patch_.VertexCount(), kFar);
  source_.assign(patch_.VertexCount(), -1);
  from_.assign(patch_.VertexCount(), -1);
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (int s = 0; s < static_cast<int>(sources.size()); ++s) {
    if (distance_[sources[s]] == 0) continue;
    distance_[sources[s]] = 0;
    source_[sources[s]] = s;
    queue.push({0, sources[s]});
  }
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > distance_[v] || (inside_only && on_boundary_[v] && d > 0)) continue;
    for (int k = ring_start_[v]; k < ring_start_[v + 1]; ++k) {
      const int h = ring_[k];
      if (inside_only && patch_.opposite[h] < 0) continue;
      const int w = patch_.Vertex(h) == v ? patch_.Vertex(Next(h)) : patch_.Vertex(h);
      const double nd = d + patch_.Length(h);
      if (nd >= distance_[w]) continue;
      distance_[w] = nd;
      source_[w] = source_[v];
      from_[w] = h;
      queue.push({nd, w});
    }
  }
}

std::vector<int> PatchPaths::BoundaryVertices() const {
  std::vector<int> vertices;
  for (int v = 0; v < patch_.VertexCount(); ++v)
    if (on_boundary_[v]) vertices.push_back(v);
  return vertices;
}

int PatchPaths::Before(int vertex) const {
  const int h = from_[vertex];
  return patch_.Vertex(h) == vertex ? patch_.Vertex(Next(h)) : patch_.Vertex(h);
}

std::vector<int> PatchPaths::Path(int vertex) const {
  std::vector<int> path;
  for (; from_[vertex] >= 0; vertex = Before(vertex)) path.push_back(from_[vertex]);
  return path;
}

}  // namespace dcharts
