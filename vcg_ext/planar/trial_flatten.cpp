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

TrialFlattening Judged(TrialFlattening trial, double bound) {
  trial.ok = trial.l2_stretch - 1 <= bound;
  trial.rejected = !trial.ok;
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
  const double bound = options.l2_bound - 1;
  RestShapes shapes = RestShapesOf(normalized.mesh);
  if (IsLargeChart(chart)) {
    if (const std::optional<PlanePoints> uv = NearStart(normalized.mesh, options.start, poll, shapes))
      return Judged(Measured(normalized, shapes, *uv), bound);
    TrialFlattening coarse;
    const auto flatten = [&](const ChartMesh& mesh) {
      TrialOptions of_coarse = options;
      of_coarse.start = nullptr;
      coarse = TrialFlatten(mesh, of_coarse, poll);
      return coarse.ok ? coarse.uv : Points2();
    };
    const std::optional<PlanePoints> uv = MapFromCoarser(normalized.mesh, flatten, poll, shapes);
    if (uv) return Judged(Measured(normalized, shapes, *uv), bound);
    if (coarse.rejected || !coarse.why.empty()) return coarse;
  }
  VertexBlockSystem system(static_cast<int>(chart.positions.rows()), triangles);
  PlanePoints uv;
  double energy = FlattenStart(normalized.mesh, shapes, options.start, system, poll, uv);
  if (!std::isfinite(energy)) return NoMap("No flat start without flipped triangles was found.");
  if (energy > kNewtonWorks) {
    energy = Descend({Kind::kSymmetricDirichlet}, {StepKind::kReweighted, kReweightedSteps, 0}, triangles,
                     shapes, system, poll, uv);
  }
  if (energy < kFarFromFlat) {
    RelaxSlivers(triangles, uv, shapes);
    // At the best scale of the map, Sander's energy is L2 - 1.
    DescentOptions steps{StepKind::kProjectedNewton, options.newton_steps, kCloseEnough};
    steps.bound = bound;
    if (options.decide_only) steps.enough = bound;
    Descend({Kind::kSander}, steps, triangles, shapes, system, poll, uv);
  }
  return Judged(Measured(normalized, shapes, uv), bound);
}

}  // namespace dcharts
