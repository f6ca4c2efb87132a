// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/split_chart.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>

#include "planar/min_cut.h"

namespace dcharts {
namespace {

std::vector<FlowEdge> DualEdges(const ChartPatch& patch) {
  std::vector<FlowEdge> edges;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h)
    if (patch.opposite[h] > h) edges.push_back({h / 3, patch.opposite[h] / 3, patch.Length(h)});
  return edges;
}

std::vector<int> Sides(int face_count, const std::vector<bool>& first) {
  std::vector<int> side(face_count);
  for (int f = 0; f < face_count; ++f) side[f] = first[f] ? 0 : 1;
  return side;
}

std::vector<double> DualDistances(const ChartPatch& patch, int source, const std::function<void()>& poll) {
  std::vector<double> distance(patch.faces.size(), std::numeric_limits<double>::infinity());
  auto centroid = [&](int f) -> Eigen::RowVector3d {
    return (patch.mesh.positions.row(patch.mesh.triangles(f, 0)) +
            patch.mesh.positions.row(patch.mesh.triangles(f, 1)) +
            patch.mesh.positions.row(patch.mesh.triangles(f, 2))) /
           3;
  };
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  distance[source] = 0;
  queue.push({0, source});
  constexpr int kPollEvery = 65536;
  for (int step = 0; !queue.empty(); ++step) {
    if (poll && step % kPollEvery == 0) poll();
    const auto [d, f] = queue.top();
    queue.pop();
    if (d > distance[f]) continue;
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      if (patch.opposite[h] < 0) continue;
      const int g = patch.opposite[h] / 3;
      const double nd = d + (centroid(f) - centroid(g)).norm();
      if (nd >= distance[g]) continue;
      distance[g] = nd;
      queue.push({nd, g});
    }
  }
  return distance;
}

// Between two faces, from which these are the distances.
std::vector<int> Halves(const ChartPatch& patch, int a, int b, const std::vector<double>& from_a,
                        const std::vector<double>& from_b) {
  const int face_count = static_cast<int>(patch.faces.size());
  // Near either end the side is given; the cut is free in the middle band.
  constexpr double kBand = 0.15;
  std::vector<int> sources, sinks;
  for (int f = 0; f < face_count; ++f) {
    const double total = from_a[f] + from_b[f], difference = from_a[f] - from_b[f];
    if (f == a || (f != b && difference < -kBand * total)) sources.push_back(f);
    if (f == b || (f != a && difference > kBand * total)) sinks.push_back(f);
  }
  return Sides(face_count, MinCut(face_count, DualEdges(patch), sources, sinks));
}

}  // namespace

std::vector<int> SplitAtOverlaps(const ChartPatch& patch, const std::vector<std::pair<int, int>>& overlaps) {
  const int face_count = static_cast<int>(patch.faces.size());
  std::vector<std::vector<int>> partners(face_count);
  for (const auto& [i, j] : overlaps) {
    partners[i].push_back(j);
    partners[j].push_back(i);
  }
  // From one pair, each side takes the faces next to it that overlap nothing on its own side.
  std::vector<int> side(face_count, -1);
  std::queue<int> queue;
  auto take = [&](int f, int s) {
    side[f] = s;
    queue.push(f);
  };
  take(overlaps.front().first, 0);
  take(overlaps.front().second, 1);
  while (!queue.empty()) {
    const int f = queue.front();
    queue.pop();
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int g = patch.opposite[h] < 0 ? -1 : patch.opposite[h] / 3;
      if (g < 0 || side[g] >= 0 || partners[g].empty()) continue;
      bool same = false, other = false;
      for (int p : partners[g]) {
        same |= side[p] == side[f];
        other |= side[p] == 1 - side[f];
      }
      if (!same && other) take(g, side[f]);
    }
  }
  std::vector<int> sources, sinks;
  for (int f = 0; f < face_count; ++f) {
    if (side[f] == 0) sources.push_back(f);
    if (side[f] == 1) sinks.push_back(f);
  }
  return Sides(face_count, MinCut(face_count, DualEdges(patch), sources, sinks));
}

std::vector<int> Bisect(const ChartPatch& patch, const std::function<void()>& poll) {
  auto farthest = [](const std::vector<double>& d) {
    return static_cast<int>(std::max_element(d.begin(), d.end()) - d.begin());
  };
  const int a = farthest(DualDistances(patch, 0, poll));
  const std::vector<double> from_a = DualDistances(patch, a, poll);
  int b = farthest(from_a);
  if (b == a) b = a == 0 ? 1 : 0;  // faces without any extent
  return Halves(patch, a, b, from_a, DualDistances(patch, b, poll));
}

std::vector<int> BisectBetween(const ChartPatch& patch, int a, int b) {
  return Halves(patch, a, b, DualDistances(patch, a, {}), DualDistances(patch, b, {}));
}

void GiveSideAnId(const ChartPatch& patch, const std::vector<int>& side, int new_id, ChartIds& ids) {
  for (size_t k = 0; k < side.size(); ++k)
    if (side[k] == 1) ids[patch.faces[k]] = new_id;
}

void PartChart(const ChartPatch& patch, const std::vector<int>& side, int new_id, ChartIds& ids,
               SeamMask& seams) {
  GiveSideAnId(patch, side, new_id, ids);
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    const int o = patch.opposite[h];
    if (o >= 0 && side[h / 3] != side[o / 3]) SetSeam(seams, patch.SurfaceHalfEdge(h));
  }
}

}  // namespace dcharts
