// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/flatten.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "planar/abf.h"
#include "planar/boundary_loops.h"
#include "planar/distortion.h"
#include "planar/flatten_start.h"
#include "planar/flatten_start_tutte.h"
#include "planar/linf_finish.h"
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
constexpr double kNearlyFlat = 0.05;  // below it Sander's energy is minimized at once
constexpr double kNewtonWorks = 3;    // above it Newton steps crawl and reweighted ones don't
constexpr double kHopeless = 1e3;     // still above it afterwards: the chart has to be cut
constexpr int kReweightedBlock = 3;   // steps
constexpr int kMaxBlocks = 40;
constexpr double kFarFromFlat = 0.3;  // above it few steps follow: such a chart will be cut or split
constexpr double kBlockGain = 0.05;   // share of the energy; a block that gains less is the last

// Reweighted steps while the map is bad, then Newton's. Returns the energy reached.
double MinimizeSymmetricDirichlet(const Triangles& triangles, const RestShapes& shapes, double energy,
                                  VertexBlockSystem& system, const Poll& poll, PlanePoints& uv) {
  const StretchEnergy dirichlet{Kind::kSymmetricDirichlet};
  for (int block = 0; block < kMaxBlocks && energy > kNewtonWorks; ++block) {
    const double before = energy;
    energy =
        Descend(dirichlet, {StepKind::kReweighted, kReweightedBlock, 0}, triangles, shapes, system, poll, uv);
    if (energy > (1 - kBlockGain) * before) break;
  }
  if (energy < kNearlyFlat) return energy;
  return Descend(dirichlet, {StepKind::kProjectedNewton, 60, 1e-2}, triangles, shapes, system, poll, uv);
}

// Moves triangles that would flip when texture coordinates are rounded to float32 apart, as far as that goes.
// `descend` lowers Sander's energy for the shapes.
void MakeSafeForFloat32(const Triangles& triangles, RestShapes& shapes, const std::function<void()>& descend,
                        const PlanePoints& uv) {
  double weight = 1e-2;
  for (int round = 0; round < 5 && ThickenThinTriangles(triangles, uv, weight, shapes) > 0; ++round) {
    RelaxSlivers(triangles, uv, shapes);
    descend();
    weight *= 10;
  }
}

bool AllAreasPositive(const Triangles& triangles, const Points2& uv) {
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto corner = [&](int i) { return uv.row(triangles(t, (k + i) % 3)); };
      const Eigen::RowVector2d e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
      if (!(e1.x() * e2.y() - e1.y() * e2.x() > 0)) return false;
    }
  }
  return uv.allFinite();
}

Flattening Failure(const std::string& why) {
  Flattening result;
  result.why = why;
  return result;
}

// A chart without area has no shape to keep: any map without flips will do, far smaller than the chart is
// long.
Flattening FlattenWithoutArea(const ChartMesh& chart, double extent) {
  constexpr double kSize = 1e-6;
  std::optional<PlanePoints> uv = StartFromTutte(chart);
  Flattening result;
  if (uv) result.uv = ToPoints(*uv, extent > 0 ? kSize * extent : 1.0);
  result.ok = uv && AllAreasPositive(chart.triangles, result.uv);
  if (!result.ok) {
    return Failure("The chart has no area, and no flat start without flipped triangles was found.");
  }
  result.l2_stretch = result.linf_stretch = 1;
  return result;
}

// `uv` in model units with the surface's area and its figures; not ok when a triangle is flipped or lost.
Flattening Finished(const NormalizedChart& normalized, const PlanePoints& uv) {
  Flattening result;
  const StretchFigures figures = MeasureStretch(normalized.mesh, ToPoints(uv, 1.0));
  const double to_surface_area = std::sqrt(figures.SurfaceArea() / figures.UvArea());
  result.uv = ToPoints(uv, normalized.scale * to_surface_area);
  if (figures.FlippedOrDegenerate() > 0 || !AllAreasPositive(normalized.mesh.triangles, result.uv)) {
    return Failure("Triangles are too small to be flattened without a flip: the chart has to be cut.");
  }
  result.l2_stretch = figures.L2();
  result.linf_stretch = figures.Linf();
  result.ok = true;
  return result;
}

// Not ok when there is no conformal map to use; the note then says why.
Flattening FlattenConformal(const NormalizedChart& normalized, RestShapes shapes, VertexBlockSystem& system,
                            const Poll& poll) {
  Flattening result;
  std::string why;
  const std::optional<PlanePoints> uv = ConformalMap(normalized.mesh, shapes, system, poll, why);
  if (uv) {
    if (ThickenThinTriangles(normalized.mesh.triangles, *uv, 1.0, shapes) == 0) {
      result = Finished(normalized, *uv);
    }
    if (!result.ok) why = "its conformal map has triangles too small for texture coordinates";
  }
  if (!result.ok) result.note = why + ", flattened with least stretch instead";
  return result;
}

// A large chart with the least stretch. Not ok and without a reason when that has to be done otherwise.
Flattening FlattenLarge(const NormalizedChart& normalized, const FlattenOptions& options, const Poll& poll) {
  Flattening coarse;
  RestShapes shapes = RestShapesOf(normalized.mesh);
  const auto flatten = [&](const ChartMesh& chart, CoarserCharts* coarser) {
    FlattenOptions of_coarse = options;
    of_coarse.coarser = coarser;
    of_coarse.start = nullptr;
    coarse = Flatten(chart, of_coarse, poll);
    return coarse.uv;
  };
  std::optional<PlanePoints> uv = MapFromCoarser(normalized, options.coarser, flatten, poll, shapes);
  if (!uv) return Failure(coarse.why);
  const Triangles& triangles = normalized.mesh.triangles;
  const VertexSweeps sweeps(static_cast<int>(uv->size()), triangles, shapes);
  if (options.linf_finish) sweeps.LowerWorst(poll, *uv);
  MakeSafeForFloat32(
      triangles, shapes, [&] { sweeps.EvenOut(poll, *uv); }, *uv);
  Flattening result = Finished(normalized, *uv);
  if (!result.ok) result.why.clear();
  return result;
}

}  // namespace

Flattening Flatten(const ChartMesh& chart, const FlattenOptions& options, const Poll& poll) {
  std::string why = WhyNotAChart(chart);
  if (!why.empty()) return Failure(why);
  const NormalizedChart normalized = Normalized(chart);
  if (!(normalized.scale > 0)) return FlattenWithoutArea(chart, normalized.extent);
  if (poll) poll();
  if (options.method == FlattenMethod::kStretchMinimizing && IsLargeChart(chart)) {
    Flattening large = FlattenLarge(normalized, options, poll);
    if (large.ok || !large.why.empty()) return large;
  }

  const Triangles& triangles = chart.triangles;
  RestShapes shapes = RestShapesOf(normalized.mesh);
  VertexBlockSystem system(static_cast<int>(chart.positions.rows()), triangles);
  std::string note;
  if (options.method == FlattenMethod::kConformal) {
    Flattening conformal = FlattenConformal(normalized, shapes, system, poll);
    if (conformal.ok) return conformal;
    note = conformal.note;
  }
  PlanePoints uv;
  double energy = FlattenStart(normalized.mesh, shapes, options.start, system, poll, uv);
  if (!std::isfinite(energy)) {
    return Failure("No flat start without flipped triangles was found: the chart has to be cut.");
  }
  energy = MinimizeSymmetricDirichlet(triangles, shapes, energy, system, poll, uv);
  if (energy > kHopeless) {
    return Failure("The chart can't be flattened without extreme stretch: it has to be cut.");
  }
  RelaxSlivers(triangles, uv, shapes);
  const int steps = energy > kFarFromFlat ? 7 : 15;
  Descend({Kind::kSander}, {StepKind::kProjectedNewton, steps, 1e-3}, triangles, shapes, system, poll, uv);
  if (options.linf_finish) LowerWorstStretch(normalized.mesh, options.l2_bound, shapes, system, poll, uv);
  MakeSafeForFloat32(
      triangles, shapes,
      [&] {
        Descend({Kind::kSander}, {StepKind::kProjectedNewton, 8, 1e-3}, triangles, shapes, system, poll, uv);
      },
      uv);

  Flattening result = Finished(normalized, uv);
  if (result.ok) result.note = note;
  return result;
}

}  // namespace dcharts
