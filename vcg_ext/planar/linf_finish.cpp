// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/linf_finish.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "planar/contractions.h"
#include "planar/distortion.h"
#include "planar/line_search.h"
#include "planar/map_region.h"
#include "planar/plane_points.h"
#include "planar/stretch_descent.h"

namespace dcharts {
namespace {

using Kind = StretchEnergy::Kind;

constexpr int kSteps = 14;
constexpr int kStepsFarFromFlat = 4;  // for charts that will be cut or split
constexpr double kFarFromFlat = 0.1;  // L2 - 1
constexpr int kPatience = 4;          // steps without a gain
constexpr int kWholeSteps = 2;        // of the whole map; the others are near the worst triangles only
constexpr int kStepsPerRegion = 5;
constexpr int kSmoothSteps = 5;  // with the lower exponent, which moves more triangles at a time
constexpr double kBad = 0.3, kBadWhenSharp = 0.5;  // of the worst contraction
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
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    worst = std::max(worst, ContractionOf(triangles, shapes, uv, t));
  return worst;
}

// Per vertex, whether it is near a triangle that is contracted by more than `bad` of the worst. All are when
// those are many.
std::vector<char> NearTheWorst(const Triangles& triangles, const RestShapes& shapes, const PlanePoints& uv,
                               double bad) {
  constexpr int kRings = 3;
  constexpr std::size_t kFew = 2;  // half of them
  std::vector<double> contraction(shapes.size());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    contraction[static_cast<std::size_t>(t)] = ContractionOf(triangles, shapes, uv, t);
  const double bound = bad * *std::max_element(contraction.begin(), contraction.end());
  std::vector<char> near = NearContracted(triangles, contraction, uv.size(), bound, kRings);
  const auto count = static_cast<std::size_t>(std::count(near.begin(), near.end(), 1));
  if (count == 0 || kFew * count > near.size()) near.assign(near.size(), 1);
  return near;
}

class Finish {
 public:
  Finish(const ChartMesh& chart, double l2_bound, const RestShapes& shapes, VertexBlockSystem& system,
         const std::function<void()>& poll)
      : chart_(chart), shapes_(shapes), system_(system), poll_(poll), l2_bound_(l2_bound) {}

  void Run(PlanePoints& uv) {
    const StretchFigures figures = MeasureStretch(chart_, ToPoints(uv, 1.0));
    least_mean_ = figures.L2() - 1;
    bound_ = figures.L2() <= l2_bound_ ? l2_bound_ - 1 : std::numeric_limits<double>::infinity();
    worst_ = figures.Linf();
    steps_ = least_mean_ > kFarFromFlat ? kStepsFarFromFlat : kSteps;
    bool whole = true;
    while (IsWorthGoingOn()) {
      std::vector<char> moves(uv.size(), 1);
      // What is stretched most is so in a few places.
      if (!whole)
        moves = NearTheWorst(chart_.triangles, shapes_, uv, step_ < kSmoothSteps ? kBad : kBadWhenSharp);
      MapRegion region(chart_, shapes_, uv, moves, system_);
      whole = !LowerIn(region, step_ == 0 ? kWholeSteps : kStepsPerRegion, uv);
    }
  }

 private:
  bool IsWorthGoingOn() const {
    return step_ < steps_ && steps_without_gain_ < kPatience && worst_ - 1 > kNothingToLower;
  }

  // By some steps. False when it has come to a standstill that the region may be the cause of.
  bool LowerIn(MapRegion& region, int steps, PlanePoints& uv) {
    constexpr int kStandstill = 2;  // steps
    PlanePoints map = region.Uv();  // goes on where it is, also when it isn't kept
    PlanePoints kept = map;
    bool stands = false;
    for (const int end = step_ + steps; step_ < end && IsWorthGoingOn() && !stands; ++step_) {
      StretchEnergy tail{Kind::kSanderTail};
      tail.reference = kReferenceOfWorst * WorstContraction(region.LocalTriangles(), region.Shapes(), map);
      tail.exponent = step_ < kSmoothSteps ? kSmoothExponent : kSharpExponent;
      if (!(tail.reference > 0)) {
        steps_ = 0;
        break;
      }
      Descend(tail, {StepKind::kProjectedNewton, 1, 0, 2}, region.LocalTriangles(), region.Shapes(),
              region.System(), poll_, map);
      ++steps_without_gain_;
      Keep(region, map, kept);
      stands = !region.IsWhole() && steps_without_gain_ >= kStandstill;
    }
    region.Write(kept, uv);
    return !stands;
  }

  // What `map` has gained, drawn toward the last one kept where its mean stretch is too high.
  void Keep(const MapRegion& region, const PlanePoints& map, PlanePoints& kept) {
    const double dearest = std::min(DearestMean(worst_) * least_mean_, bound_);
    PlanePoints candidate = map;
    StretchFigures figures = region.Measure(candidate);
    for (int blend = 0; blend < kMaxBlends && figures.L2() - 1 > dearest; ++blend) {
      for (std::size_t v = 0; v < kept.size(); ++v) candidate[v] = 0.5 * (candidate[v] + kept[v]);
      figures = region.Measure(candidate);
    }
    if (figures.L2() - 1 > dearest || !(figures.Linf() < worst_)) return;
    if (!std::isfinite(MapEnergy({Kind::kSander}, region.LocalTriangles(), region.Shapes(), candidate)))
      return;
    if (figures.Linf() - 1 < (1 - kGain) * (worst_ - 1)) steps_without_gain_ = 0;
    kept = std::move(candidate);
    worst_ = figures.Linf();
  }

  const ChartMesh& chart_;
  const RestShapes& shapes_;
  VertexBlockSystem& system_;
  const std::function<void()>& poll_;
  const double l2_bound_;
  double least_mean_ = 0, bound_ = 0;  // of L2 - 1
  double worst_ = 0;
  int steps_ = 0, step_ = 0, steps_without_gain_ = 0;
};

}  // namespace

void LowerWorstStretch(const ChartMesh& chart, double l2_bound, RestShapes& shapes, VertexBlockSystem& system,
                       const std::function<void()>& poll, PlanePoints& uv) {
  RelaxSlivers(chart.triangles, uv, shapes);
  Finish(chart, l2_bound, shapes, system, poll).Run(uv);
}

}  // namespace dcharts
