// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/trial_flatten.h"

#include <cmath>
#include <optional>
#include <utility>

#include "planar/boundary_loops.h"
#include "planar/distortion.h"
#include "planar/flatten_start.h"
#include "planar/line_search.h"
#include "planar/map_from_coarser.h"
#include "planar/normalized_chart.h"
#include "planar/overlap.h"
#include "planar/plane_points.h"
#include "planar/rest_shapes.h"
#include "planar/stretch_descent.h"
#include "planar/vertex_descent.h"

namespace dcharts {
namespace {

using Kind = StretchEnergy::Kind;
using Poll = std::function<void()>;

// Symmetric Dirichlet energies over 4, minus 1, as in StretchEnergy:
constexpr double kNewtonWorks = 3;  // above it reweighted steps come first
constexpr double kFarFromFlat = 3;  // still above it after them: no chart that anybody would want
constexpr double kHopeless = 100;   // of a start: nothing brings it below a bound such as kUsualBound
constexpr double kUsualBound = 2;   // L2 stretch
constexpr int kReweightedSteps = 3;
constexpr double kCloseEnough = 0.05;  // of L2 - 1: what the last Newton step may still gain

double Dirichlet(const Triangles& triangles, const RestShapes& shapes, const PlanePoints& uv) {
  return MapEnergy({Kind::kSymmetricDirichlet}, triangles, shapes, uv);
}

TrialFlattening NoMap(const std::string& why) {
  TrialFlattening result;
  result.why = why;
  return result;
}

TrialFlattening Measured(const NormalizedChart& normalized, const RestShapes& shapes, const PlanePoints& uv) {
  TrialFlattening result;
  const StretchFigures figures = MeasureStretch(normalized.mesh, ToPoints(uv, 1.0));
  result.energy = Dirichlet(normalized.mesh.triangles, shapes, uv);
  result.l2_stretch = figures.L2();
  result.linf_stretch = figures.Linf();
  result.uv = ToPoints(uv, normalized.scale * std::sqrt(figures.SurfaceArea() / figures.UvArea()));
  return result;
}

size_t CountOverlaps(const Points2& uv, const Triangles& rim) {
  return rim.rows() > 0 ? OverlappingPairs(OnGrid(uv, rim), kClearOverlap).size() : 0;
}

TrialFlattening Judged(TrialFlattening trial, const TrialOptions& options, const Triangles& rim) {
  trial.rejected = !(trial.l2_stretch <= options.l2_bound);
  if (!trial.rejected) trial.overlaps = CountOverlaps(trial.uv, rim);
  trial.ok = !trial.rejected && trial.overlaps == 0;
  return trial;
}

// The map of a large chart that is evened out from a start that is good but for some places; nothing without
// one.
std::optional<PlanePoints> NearStart(const ChartMesh& chart, const Points2* start, const Poll& poll,
                                     RestShapes& shapes) {
  if (!IsUsableStart(chart, start)) return std::nullopt;
  PlanePoints uv = ToPlanePoints(*start);
  if (!(ScaleToBest(chart.triangles, shapes, uv) < kGoodKnown)) return std::nullopt;
  RelaxSlivers(chart.triangles, uv, shapes);
  VertexSweeps(static_cast<int>(uv.size()), chart.triangles, shapes).EvenOut(poll, uv);
  return uv;
}

}  // namespace

TrialFlattening TrialFlatten(const ChartMesh& chart, const TrialOptions& options, const Poll& poll) {
  std::string why = WhyNotAChart(chart);
  if (!why.empty()) return NoMap(why);
  const NormalizedChart normalized = Normalized(chart);
  if (!(normalized.scale > 0)) return NoMap("The chart has no area.");
  if (poll) poll();

  const Triangles& triangles = chart.triangles;
  RestShapes shapes = RestShapesOf(normalized.mesh);
  const Triangles rim = options.no_overlap ? RimOf(triangles) : Triangles();
  if (IsLargeChart(chart)) {
    if (const std::optional<PlanePoints> uv = NearStart(normalized.mesh, options.start, poll, shapes))
      return Judged(Measured(normalized, shapes, *uv), options, rim);
    TrialFlattening coarse;
    const auto flatten = [&](const ChartMesh& mesh, CoarserCharts* coarser) {
      TrialOptions of_coarse = options;
      of_coarse.start = nullptr;
      of_coarse.coarser = coarser;
      coarse = TrialFlatten(mesh, of_coarse, poll);
      return coarse.ok ? coarse.uv : Points2();
    };
    const std::optional<PlanePoints> uv = MapFromCoarser(normalized, options.coarser, flatten, poll, shapes);
    if (uv) return Judged(Measured(normalized, shapes, *uv), options, rim);
    if (coarse.rejected || coarse.overlaps > 0 || !coarse.why.empty()) return coarse;
  }
  VertexBlockSystem system(static_cast<int>(chart.positions.rows()), triangles);
  PlanePoints uv;
  double energy = FlattenStart(normalized.mesh, shapes, options.start, system, poll, uv);
  if (!std::isfinite(energy)) return NoMap("No flat start without flipped triangles was found.");
  if (energy > kHopeless && options.l2_bound < kUsualBound)
    return Judged(Measured(normalized, shapes, uv), options, rim);
  if (energy > kNewtonWorks) {
    energy = Descend({Kind::kSymmetricDirichlet}, {StepKind::kReweighted, kReweightedSteps, 0}, triangles,
                     shapes, system, poll, uv);
  }
  if (CountOverlaps(ToPoints(uv, 1.0), rim) >= kClearOverlap) {
    TrialFlattening trial = Measured(normalized, shapes, uv);
    trial.overlaps = kClearOverlap;
    return trial;
  }
  if (energy < kFarFromFlat) {
    RelaxSlivers(triangles, uv, shapes);
    // At the best scale of the map, Sander's energy is L2 - 1.
    DescentOptions steps{StepKind::kProjectedNewton, options.newton_steps, kCloseEnough};
    steps.bound = options.l2_bound - 1;
    if (options.decide_only) steps.enough = steps.bound;
    Descend({Kind::kSander}, steps, triangles, shapes, system, poll, uv);
  }
  return Judged(Measured(normalized, shapes, uv), options, rim);
}

}  // namespace dcharts
