// SPDX-License-Identifier: GPL-3.0-or-later
#include "dcharts.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "pattern/pattern.h"
#include "pattern/pattern_steps.h"
#include "pattern/surface/base_mesh.h"
#include "pattern/surface/charts_for_pattern.h"
#include "pattern/surface/data_coordinates.h"
#include "pattern/surface/smooth_seams.h"
#include "pattern/surface/symmetric_charts.h"
#include "pattern/surface/symmetric_mesh.h"
#include "pattern/texts.h"
#include "surface/make_charts.h"
#include "surface/workspace.h"

namespace dcharts {
namespace {

// What the material asks of the charts.
Params ForMaterial(const Params& params) {
  Params material = params;
  if (params.material == PatternMaterial::kFabric) {
    // Conformal maps change lengths where those of least stretch don't: such charts must be flatter.
    constexpr double kFlatter = 0.3;
    material.method = FlattenMethod::kConformal;
    if (params.max_stretch > 0) material.max_stretch = 1 + kFlatter * (params.StretchBound() - 1);
  } else {
    // Paper does not stretch. What little a chart still has is taken up by folding.
    constexpr double kStrict = 1.0001;
    material.method = FlattenMethod::kStretchMinimizing;
    material.max_stretch = std::min(params.StretchBound(), kStrict);
    material.max_dart_percent = std::max(params.max_dart_percent, Params().max_dart_percent);
  }
  return material;
}

// All but scale and what has to do with the user's faces.
PatternResult PatternOfMesh(BaseMesh& base, const Params& params, double scale, Progress& progress) {
  const auto& surface = base.Surface();
  base.Work().KeepBorders(params, progress);
  PatternResult result;
  ChartIds ids;
  SeamMask seams;
  KnownFlattenings known;
  constexpr double kChartsShare = 0.6, kFlatShare = 0.75;
  MakeCharts(surface, params, ChartsFor::kPattern, kChartsShare, progress, ids, seams, known, result.report);
  if (base.Halves().IsSymmetric()) {
    progress.BeginStage("Mirroring charts...", kChartsShare, kChartsShare);
    if (MakeChartsSymmetric(surface, base.Halves(), params, progress, ids, seams)) {
      known = KnownFlattenings();
      progress.Log("The model is symmetric: its pieces are made in mirrored pairs.");
    }
  }
  progress.BeginStage("Flattening charts...", kChartsShare, kFlatShare);
  const auto flatten = [&](const SurfaceData& data, Workspace& ready, const KnownFlattenings& flat) {
    const double to_mm = scale * DataCoordinates(data, ready.Surface()).Scale();
    ChartsForPattern charts(ready.Surface(), params, to_mm, base.Halves(), progress);
    charts.Flatten(ids, seams, flat);
    ready.ReleaseBorders(seams);
    return charts.Take(ids, seams, data, scale, ready.SourceFaces());
  };
  FlatCharts charts;
  if (params.material == PatternMaterial::kFabric) {
    SurfaceData smooth = WithSmoothSeams(base.Mesh(), surface, seams);
    if (base.Halves().IsSymmetric()) MirrorFirstHalf(base.Mesh(), base.Halves(), smooth);
    Workspace ready(smooth);
    ready.KeepBordersOf(base.Work());
    charts = flatten(smooth, ready, KnownFlattenings());
    base.Work().ReleaseBorders();
  } else {
    charts = flatten(base.Mesh(), base.Work(), known);
  }
  result.pattern = PatternOfCharts(std::move(charts), params, progress, kFlatShare, 1);
  result.report.seam_length = SeamLength(surface, seams);
  return result;
}

}  // namespace

PatternResult MakePattern(const SurfaceData& mesh, const Params& params, Progress& progress) {
  const Params material = ForMaterial(params);
  progress.BeginStage("Reading the mesh...", 0, 0);
  BaseMesh base(mesh, [&progress] { progress.Poll(); });
  constexpr double kMillimetresPerInch = 25.4;
  const double unit = params.units == LengthUnit::kInch ? kMillimetresPerInch : 1;
  const double model_side = LongestSide(mesh);
  const double side = params.size > 0 ? params.size * unit : model_side * unit;
  constexpr double kSmallest = 1, kLargest = 1e5;  // mm
  if (!(side >= kSmallest && side <= kLargest))
    throw Error("The finished object would be " + LengthText(side) +
                " long. Give the size that it is to have in `size`, from 1 mm to 100 m.");
  const double scale = side / model_side;

  // A texture and borders to keep lie on the triangles of the user's mesh, and a number of charts that was
  // asked for might not be met by mirrored ones.
  if (!params.print_texture && !params.KeepsBorders()) {
    base.Coarsen(params.material);
    if (params.target_charts == 0) base.MakeSymmetric(params.material);
  }
  PatternResult result = PatternOfMesh(base, material, scale, progress);
  base.ToUsersFaces(result.pattern);
  result.pattern.scale = scale;
  Report& report = result.report;
  report.charts = static_cast<int>(result.pattern.pieces.size());
  report.unassigned_faces = 0;
  report.darts = 0;
  for (const Piece& piece : result.pattern.pieces) *report.darts += static_cast<int>(piece.darts.size());
  return result;
}

}  // namespace dcharts
