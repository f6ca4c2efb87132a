// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/stretch_darts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/pi.h"
#include "planar/distortion.h"
#include "planar/overlap.h"
#include "surface/open_chart.h"
#include "surface/patch_paths.h"

namespace dcharts {
namespace {

constexpr int kMostDarts = 12;

// Area-weighted mean of the worst stretch of the faces around each vertex.
std::vector<double> VertexStretch(const ChartPatch& patch, const Points2& uv) {
  std::vector<double> sum(patch.VertexCount(), 0), weight(patch.VertexCount(), 0);
  for (int f = 0; f < static_cast<int>(patch.faces.size()); ++f) {
    Eigen::Matrix3d corners;
    Eigen::Matrix<double, 3, 2> flat;
    for (int i = 0; i < 3; ++i) {
      corners.row(i) = patch.mesh.positions.row(patch.mesh.triangles(f, i));
      flat.row(i) = uv.row(patch.mesh.triangles(f, i));
    }
    const TriangleStretch stretch = StretchOfTriangle(corners, flat);
    for (int i = 0; i < 3; ++i) {
      sum[patch.mesh.triangles(f, i)] += stretch.surface_area * stretch.largest;
      weight[patch.mesh.triangles(f, i)] += stretch.surface_area;
    }
  }
  for (int v = 0; v < patch.VertexCount(); ++v) sum[v] = weight[v] > 0 ? sum[v] / weight[v] : 0;
  return sum;
}

bool Reached(const Flattening& flat, const DartGoal& goal) {
  return flat.l2_stretch <= goal.l2_stretch && flat.linf_stretch <= goal.linf_stretch;
}

// A dart is worth its length when the worst stretch falls by as much as this for each unit of it, or, where
// the mean stretch is too high, when that falls by a fair share.
bool Helps(const Flattening& before, const Flattening& after, double length, const DartGoal& goal) {
  constexpr double kLinfPerUnit = 1.5;
  constexpr double kShareOfL2 = 0.1;
  if (!after.ok) return false;
  if (before.l2_stretch > goal.l2_stretch)
    return after.l2_stretch - 1 < (1 - kShareOfL2) * (before.l2_stretch - 1);
  if (after.l2_stretch > goal.l2_stretch) return false;
  return before.linf_stretch - std::max(after.linf_stretch, goal.linf_stretch) >
         kLinfPerUnit * length / goal.unit;
}

// The vertices at which a chart of flat and rolled parts comes to a point; none when it is curved elsewhere,
// or in too many places.
std::vector<int> ConePoints(const ChartPatch& patch, const PatchPaths& paths) {
  constexpr double kPoint = 0.02, kFlat = 1e-4;
  std::vector<int> points;
  const std::vector<double> angle = AngleSums(patch);
  for (int v = 0; v < patch.VertexCount(); ++v) {
    if (paths.OnBoundary(v)) continue;
    const double curvature = std::abs(2 * kPi - angle[v]);
    if (curvature > kPoint) points.push_back(v);
    if ((curvature > kFlat && curvature <= kPoint) || points.size() > kMostDarts) return {};
  }
  return points;
}

// A dart to each cone point, when the chart has no stretch at all then and that is worth the length: one by
// one they would not lower the worst stretch.
bool CutConePoints(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart) {
  constexpr double kL2PerUnit = 0.005, kNoStretch = 1e-5;
  std::vector<int> points = ConePoints(chart.patch, PatchPaths(chart.patch));
  if (points.empty()) return false;
  DartedChart darted{{}, 0, chart.patch, {}};
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
    if (!(length <= goal.longest && total_length <= goal.most_length)) return false;
    const std::vector<int> cut = paths.Path(darted.patch.Vertex(*nearest));
    darted.edges.insert(darted.edges.end(), cut.begin(), cut.end());
    darted.count += !cut.empty();  // a dart may have run through it
    darted.patch = CutOpen(darted.patch, cut);
    corner_of.erase(nearest);
  }
  FlattenOptions options;
  options.l2_bound = goal.l2_stretch;
  darted.flat = Flatten(darted.patch.mesh, options, poll);
  const double share = chart.patch.Area() / (goal.unit * goal.unit);
  if (!darted.flat.ok || darted.flat.l2_stretch > 1 + kNoStretch ||
      (chart.flat.l2_stretch - darted.flat.l2_stretch) * share < kL2PerUnit * total_length / goal.unit ||
      !OverlappingPairs(OnGrid(darted.flat.uv, darted.patch.mesh.triangles), 1).empty())
    return false;
  chart = std::move(darted);
  return true;
}

}  // namespace

DartedChart CutStretchDarts(const ChartPatch& patch, const Flattening* known, const DartGoal& goal,
                            const std::function<void()>& poll) {
  constexpr int kMostFailures = 3;
  DartedChart chart;
  chart.patch = patch;
  FlattenOptions options;
  options.l2_bound = goal.l2_stretch;
  chart.flat = known ? *known : Flatten(patch.mesh, options, poll);
  double total_length = 0;
  if (!chart.flat.ok || CutConePoints(goal, poll, chart)) return chart;
  std::vector<char> hopeless(patch.faces.size(), 0);  // darts to these faces were of no use
  for (int failures = 0;
       chart.count < kMostDarts && failures < kMostFailures && !Reached(chart.flat, goal);) {
    const ChartPatch& open = chart.patch;
    const std::vector<double> stretch = VertexStretch(open, chart.flat.uv);
    PatchPaths paths(open);
    paths.Run(paths.BoundaryVertices(), true);
    int worst = -1, innermost = -1;
    for (int h = 0; h < open.HalfEdgeCount(); ++h) {
      const int v = open.Vertex(h);
      const double reach = std::min(goal.longest, goal.most_length - total_length);
      if (hopeless[h / 3] || paths.OnBoundary(v) || !(paths.Distance(v) <= reach)) continue;
      if (worst < 0 || stretch[v] > stretch[worst]) worst = v;
      if (innermost < 0 || paths.Distance(v) > paths.Distance(innermost)) innermost = v;
    }
    if (worst < 0) break;
    // A round chart is stretched most at its rim, and yet a cut to its middle may relieve it more.
    std::vector<int> tips{worst};
    if (chart.flat.l2_stretch > goal.l2_stretch && innermost != worst) tips.push_back(innermost);
    double best_gain = -1, best_length = 0;
    DartedChart best;
    for (int tip : tips) {
      const double length = paths.Distance(tip);
      const std::vector<int> cut = paths.Path(tip);
      DartedChart trial{cut, 1, CutOpen(open, cut), {}};
      trial.flat = Flatten(trial.patch.mesh, options, poll);
      const double gain = (chart.flat.l2_stretch - trial.flat.l2_stretch) / length;
      if (!Helps(chart.flat, trial.flat, length, goal) || (tip != worst && gain <= best_gain) ||
          !OverlappingPairs(OnGrid(trial.flat.uv, trial.patch.mesh.triangles), 1).empty())
        continue;
      best_gain = gain;
      best_length = length;
      best = std::move(trial);
    }
    if (best.count > 0) {
      chart.edges.insert(chart.edges.end(), best.edges.begin(), best.edges.end());
      ++chart.count;
      total_length += best_length;
      chart.patch = std::move(best.patch);
      chart.flat = std::move(best.flat);
      continue;
    }
    ++failures;
    PatchPaths around(open);
    around.Run({worst}, false);
    for (int h = 0; h < open.HalfEdgeCount(); ++h)
      if (around.Distance(open.Vertex(h)) <= paths.Distance(worst)) hopeless[h / 3] = 1;
  }
  return chart;
}

}  // namespace dcharts
