// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/linf_finish.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planar/distortion.h"
#include "planar/line_search.h"
#include "planar/plane_points.h"
#include "planar/stretch_descent.h"

namespace dcharts {
namespace {

using Kind = StretchEnergy::Kind;

constexpr int kSteps = 14;
constexpr int kStepsFarFromFlat = 4;  // for charts that will be cut or split
constexpr double kFarFromFlat = 0.1;  // L2 - 1
constexpr int kPatience = 4;          // steps without a gain
constexpr int kSmoothSteps = 5;       // with the lower exponent, which moves more triangles at a time
constexpr int kSmoothExponent = 6;
constexpr int kSharpExponent = 12;
constexpr double kReferenceOfWorst = 0.85;  // the tail begins below the worst triangle
constexpr double kGain = 3e-3;              // of Linf - 1
constexpr double kNothingToLower = 1e-7;    // Linf - 1
constexpr int kMaxBlends = 3;

// The largest factor on L2 - 1 for a worst stretch that is lower than this one. A map of the least symmetric
// Dirichlet energy has about a tenth more than the least.
double DearestMean(double worst) {
  constexpr double kLeast = 1.05, kMost = 1.2;
  constexpr double kSmall = 1.3, kLarge = 1.45;  // worst stretch
  const double share = (worst - kSmall) / (kLarge - kSmall);
  return kLeast + (kMost - kLeast) * std::min(std::max(share, 0.0), 1.0);
}

double WorstContraction(const Triangles& triangles, const RestShapes& shapes, const PlanePoints& uv) {
  double worst = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const RestShape& shape = shapes[static_cast<std::size_t>(t)];
    if (shape.sliver) continue;
    const Complex z0 = uv[static_cast<std::size_t>(triangles(t, 0))];
    const Complex e1 = uv[static_cast<std::size_t>(triangles(t, 1))] - z0;
    const Complex e2 = uv[static_cast<std::size_t>(triangles(t, 2))] - z0;
    worst = std::max(worst, TriangleContraction(shape, e1, e2));
  }
  return worst;
}

}  // namespace

void LowerWorstStretch(const ChartMesh& chart, double l2_bound, RestShapes& shapes, VertexBlockSystem& system,
                       const std::function<void()>& poll, PlanePoints& uv) {
  RelaxSlivers(chart.triangles, uv, shapes);
  StretchFigures figures = MeasureStretch(chart, ToPoints(uv, 1.0));
  const double least_mean = figures.L2() - 1;
  const double bound = figures.L2() <= l2_bound ? l2_bound - 1 : std::numeric_limits<double>::infinity();
  double worst = figures.Linf();
  const int steps = least_mean > kFarFromFlat ? kStepsFarFromFlat : kSteps;
  PlanePoints map = uv;  // goes on where it is, also when it isn't kept
  int steps_without_gain = 0;
  for (int step = 0; step < steps && steps_without_gain < kPatience; ++step) {
    if (!(worst - 1 > kNothingToLower)) return;
    StretchEnergy tail{Kind::kSanderTail};
    tail.reference = kReferenceOfWorst * WorstContraction(chart.triangles, shapes, map);
    tail.exponent = step < kSmoothSteps ? kSmoothExponent : kSharpExponent;
    if (!(tail.reference > 0)) return;
    Descend(tail, {StepKind::kProjectedNewton, 1, 0, 2}, chart.triangles, shapes, system, poll, map);
    ++steps_without_gain;

    // A map with too high a mean stretch is drawn toward the last one kept.
    const double dearest = std::min(DearestMean(worst) * least_mean, bound);
    PlanePoints candidate = map;
    figures = MeasureStretch(chart, ToPoints(candidate, 1.0));
    for (int blend = 0; blend < kMaxBlends && figures.L2() - 1 > dearest; ++blend) {
      for (std::size_t v = 0; v < uv.size(); ++v) candidate[v] = 0.5 * (candidate[v] + uv[v]);
      figures = MeasureStretch(chart, ToPoints(candidate, 1.0));
    }
    if (figures.L2() - 1 > dearest || !(figures.Linf() < worst)) continue;
    if (!std::isfinite(MapEnergy({Kind::kSander}, chart.triangles, shapes, candidate))) continue;
    if (figures.Linf() - 1 < (1 - kGain) * (worst - 1)) steps_without_gain = 0;
    uv = std::move(candidate);
    worst = figures.Linf();
  }
}

}  // namespace dcharts
