// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/cone_point_darts.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/pi.h"
#include "surface/open_chart.h"
#include "surface/patch_paths.h"

namespace dcharts {
namespace {

// The vertices at which a chart of flat and rolled parts comes to a point; none when it is curved elsewhere,
// or in too many places.
std::vector<int> ConePoints(const ChartPatch& patch, const PatchPaths& paths) {
  constexpr double kPoint = 0.02, kFlat = 1e-4;
  constexpr size_t kMostPoints = 12;
  std::vector<int> points;
  const std::vector<double> angle = AngleSums(patch);
  for (int v = 0; v < patch.VertexCount(); ++v) {
    if (paths.OnBoundary(v)) continue;
    const double curvature = std::abs(2 * kPi - angle[v]);
    if (curvature > kPoint) points.push_back(v);
    if ((curvature > kFlat && curvature <= kPoint) || points.size() > kMostPoints) return {};
  }
  return points;
}

}  // namespace

bool HasConePoints(const ChartPatch& patch) { return !ConePoints(patch, PatchPaths(patch)).empty(); }

bool CutConePoints(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart) {
  constexpr double kL2PerUnit = 0.005, kNoStretch = 1e-5;
  std::vector<int> points = ConePoints(chart.patch, PatchPaths(chart.patch));
  if (points.empty()) return false;
  DartedChart darted = Uncut(chart.patch);
  std::vector<int> corner_of;  // a vertex may get another number by a cut, a corner doesn't
  for (int v : points) {
    int h = 0;
    while (chart.patch.Vertex(h) != v) ++h;
    corner_of.push_back(h);
  }
  double total_length = 0;
  while (!corner_of.empty()) {
    PatchPaths paths(darted.patch);
    paths.Run(paths.BoundaryVertices(), true);
    const auto distance = [&](int h) { return paths.Distance(darted.patch.Vertex(h)); };
    const auto nearest = std::min_element(corner_of.begin(), corner_of.end(),
                                          [&](int g, int h) { return distance(g) < distance(h); });
    const double length = distance(*nearest);
    total_length += length;
    if (!(length <= goal.longest)) return false;
    const std::vector<int> cut = paths.Path(darted.patch.Vertex(*nearest));
    darted.edges.insert(darted.edges.end(), cut.begin(), cut.end());
    darted.count += !cut.empty();  // a dart may have run through it
    darted.tips.push_back(*nearest);
    darted.patch = CutOpen(darted.patch, cut);
    corner_of.erase(nearest);
  }
  darted.flat = FlatWithFinish(darted.patch, goal, poll);
  const double share = chart.patch.Area() / (goal.unit * goal.unit);
  if (!darted.flat.ok || darted.flat.l2_stretch > 1 + kNoStretch ||
      (chart.flat.l2_stretch - darted.flat.l2_stretch) * share < kL2PerUnit * total_length / goal.unit ||
      Overlaps(darted))
    return false;
  chart = std::move(darted);
  return true;
}

}  // namespace dcharts
