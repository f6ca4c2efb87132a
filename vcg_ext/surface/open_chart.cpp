// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/open_chart.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "common/pi.h"
#include "common/union_find.h"
#include "surface/patch_paths.h"

namespace dcharts {
namespace {

int FarthestFromCentre(const ChartPatch& patch) {
  const Eigen::RowVector3d centre = patch.mesh.positions.colwise().mean();
  int best = 0;
  (patch.mesh.positions.rowwise() - centre).rowwise().squaredNorm().maxCoeff(&best);
  return best;
}

std::vector<int> SlitOfSphere(const ChartPatch& patch) {
  PatchPaths paths(patch);
  const int start = FarthestFromCentre(patch);
  paths.Run({start}, false);
  int end = start;
  for (int v = 0; v < patch.VertexCount(); ++v)
    if (paths.Distance(v) > paths.Distance(end) && paths.Distance(v) < PatchPaths::kFar) end = v;
  std::vector<int> slit = paths.Path(end);
  // A slit of one edge opens nothing: go one edge on.
  if (slit.size() == 1) {
    for (int h = 0; h < patch.HalfEdgeCount(); ++h)
      if (patch.Vertex(h) == end && patch.Vertex(Next(h)) != start) {
        slit.push_back(h);
        break;
      }
  }
  return slit;
}

}  // namespace

std::vector<double> AngleSums(const ChartPatch& patch) {
  std::vector<double> sum(patch.VertexCount(), 0);
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    const Eigen::Vector3d p = patch.mesh.positions.row(patch.Vertex(h));
    const Eigen::Vector3d a = patch.mesh.positions.row(patch.Vertex(Next(h))).transpose() - p;
    const Eigen::Vector3d b = patch.mesh.positions.row(patch.Vertex(Previous(h))).transpose() - p;
    const double cross = a.cross(b).norm(), dot = a.dot(b);
    if (cross > 0 || dot != 0) sum[patch.Vertex(h)] += std::atan2(cross, dot);
  }
  return sum;
}

std::vector<int> CutsThatOpenHandles(const ChartPatch& patch) {
  const std::vector<std::vector<int>> loops = LoopsOf(patch);
  const int loop_count = static_cast<int>(loops.size());
  const int genus = (2 - loop_count - EulerCharacteristic(patch)) / 2;
  if (genus == 0) return loops.empty() ? SlitOfSphere(patch) : std::vector<int>{};

  // The longest loop is the root: contracted to a point it changes no handle. The other loops are capped by
  // one dual node each.
  int root_loop = -1;
  double longest = -1;
  std::vector<int> cap_of(patch.HalfEdgeCount(), -1);
  for (int l = 0; l < loop_count; ++l) {
    double length = 0;
    for (int h : loops[l]) {
      length += patch.Length(h);
      cap_of[h] = l;
    }
    if (length > longest) {
      longest = length;
      root_loop = l;
    }
  }
  std::vector<int> roots;
  if (root_loop < 0)
    roots.push_back(FarthestFromCentre(patch));
  else
    for (int h : loops[root_loop]) roots.push_back(patch.Vertex(h));
  PatchPaths tree(patch);
  tree.Run(roots, false);

  std::vector<char> in_tree(patch.HalfEdgeCount(), 0);
  auto mark = [&](int h) {
    in_tree[h] = 1;
    if (patch.opposite[h] >= 0) in_tree[patch.opposite[h]] = 1;
  };
  for (int v = 0; v < patch.VertexCount(); ++v)
    if (tree.From(v) >= 0) mark(tree.From(v));
  if (root_loop >= 0)
    for (int h : loops[root_loop]) mark(h);

  std::vector<std::tuple<double, int>> candidates;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h)
    if (patch.opposite[h] < h && !in_tree[h])
      candidates.push_back(
          {tree.Distance(patch.Vertex(h)) + tree.Distance(patch.Vertex(Next(h))) + patch.Length(h), h});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return std::get<0>(a) > std::get<0>(b); });
  const int face_count = static_cast<int>(patch.faces.size());
  UnionFind dual(face_count + loop_count);
  std::vector<char> cut(patch.HalfEdgeCount(), 0);
  for (const auto& [length, h] : candidates) {
    const int across = patch.opposite[h] >= 0 ? patch.opposite[h] / 3 : face_count + cap_of[h];
    if (dual.Join(h / 3, across)) continue;
    cut[h] = 1;
    for (int v : {patch.Vertex(h), patch.Vertex(Next(h))})
      for (int k : tree.Path(v)) cut[std::max(k, patch.opposite[k])] = 1;
  }
  std::vector<int> edges;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h)
    if (cut[h] && patch.opposite[h] >= 0) edges.push_back(h);
  return edges;
}

std::vector<int> CutsThatJoinLoops(const ChartPatch& patch, bool to_disk) {
  const std::vector<std::vector<int>> loops = LoopsOf(patch);
  if (loops.size() < 2) return {};

  // By Gauss-Bonnet a loop's total turning is 2 pi minus the curvature it encloses, -2 pi for a hole in a
  // flat part.
  const std::vector<double> angle = AngleSums(patch);
  std::vector<char> on_loop(patch.VertexCount(), 0);
  std::vector<double> turning;
  for (const auto& loop : loops) {
    double sum = 0;
    for (int h : loop) {
      sum += kPi - angle[patch.Vertex(h)];
      on_loop[patch.Vertex(h)] = 1;
    }
    turning.push_back(sum);
  }
  const int outer = static_cast<int>(std::max_element(turning.begin(), turning.end()) - turning.begin());
  double curvature = 0;
  for (int v = 0; v < patch.VertexCount(); ++v)
    if (!on_loop[v]) curvature += std::abs(2 * kPi - angle[v]);
  // What a hole may stand for without a cut: little where the chart is developable (there it would be the
  // only stretch), more where the chart is curved anyway.
  const double tolerance = std::clamp(0.2 * curvature, 0.05, 1.0);

  std::vector<int> sources, loop_of;
  for (int l = 0; l < static_cast<int>(loops.size()); ++l)
    if (l == outer || to_disk || std::abs(turning[l] + 2 * kPi) > tolerance)
      for (int h : loops[l]) {
        sources.push_back(patch.Vertex(h));
        loop_of.push_back(l);
      }

  // Where the regions nearest to two loops meet, a path joins them; the shortest such paths that join all are
  // the cuts.
  PatchPaths paths(patch);
  paths.Run(sources, true);
  std::vector<std::tuple<double, int>> meetings;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    if (patch.opposite[h] < h) continue;
    const int v = patch.Vertex(h), w = patch.Vertex(Next(h));
    if (paths.Source(v) < 0 || paths.Source(w) < 0 || loop_of[paths.Source(v)] == loop_of[paths.Source(w)])
      continue;
    meetings.push_back({paths.Distance(v) + paths.Distance(w) + patch.Length(h), h});
  }
  std::stable_sort(meetings.begin(), meetings.end(),
                   [](const auto& a, const auto& b) { return std::get<0>(a) < std::get<0>(b); });
  UnionFind joined(static_cast<int>(loops.size()));
  std::vector<int> edges;
  for (const auto& [length, h] : meetings) {
    const int v = patch.Vertex(h), w = patch.Vertex(Next(h));
    if (!joined.Join(loop_of[paths.Source(v)], loop_of[paths.Source(w)])) continue;
    edges.push_back(h);
    for (int end : {v, w})
      for (int k : paths.Path(end)) edges.push_back(k);
  }
  return edges;
}

}  // namespace dcharts
