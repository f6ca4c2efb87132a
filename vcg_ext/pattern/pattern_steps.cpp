// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/pattern_steps.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "pattern/build_pieces.h"
#include "pattern/seam_graph.h"
#include "pattern/simplify_seams.h"
#include "planar/distortion.h"

namespace dcharts {
namespace {

// Fabric is laid flat conformally with seams as long as on the model, which makes curved pieces too small in
// their middles: enlarged all alike, they have the model's area together.
void GiveModelArea(FlatCharts& charts) {
  double model = 0, flat = 0;
  for (const FlatChart& chart : charts.charts) {
    const StretchFigures figures = MeasureStretch(chart.mesh, chart.uv);
    model += figures.SurfaceArea();
    flat += figures.UvArea();
  }
  if (!(flat > 0)) return;
  const double factor = std::sqrt(model / flat);
  for (FlatChart& chart : charts.charts) chart.uv *= factor;
}

}  // namespace

Pattern PatternOfCharts(FlatCharts charts, const Params& params, Progress& progress, double from, double to) {
  const bool is_paper = params.material == PatternMaterial::kPaper;
  const auto poll = [&] { progress.Poll(); };
  if (!is_paper) GiveModelArea(charts);
  progress.BeginStage("Simplifying outlines...", from, from + 0.2 * (to - from));
  const SeamGraph graph = SeamsOf(charts);
  SimplifyOptions simplify;
  simplify.tolerance = params.simplify_tolerance;
  // Within what is promised of finished seams, 1 % and 0.1 %.
  simplify.most_ease = is_paper ? 0.0005 : 0.005;
  Pattern pattern = BuildPieces(charts, graph, SimplifySeams(charts, graph, simplify, poll));
  pattern.material = params.material;
  return pattern;
}

}  // namespace dcharts
