// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/pattern_steps.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "pattern/build_pieces.h"
#include "pattern/equal_seams.h"
#include "pattern/seam_graph.h"
#include "pattern/simplify_seams.h"

namespace dcharts {
namespace {

std::vector<std::vector<int>> Boundaries(const FlatCharts& charts) {
  std::vector<std::vector<int>> boundary(charts.charts.size());
  for (const auto& edge : charts.edges)
    for (const ChartEdge& side : edge) boundary[side.chart].push_back(side.half_edge);
  for (auto& edges : boundary) std::sort(edges.begin(), edges.end());
  return boundary;
}

}  // namespace

Pattern PatternOfCharts(FlatCharts charts, const Params& params, Progress& progress, double from, double to) {
  const bool is_paper = params.material == PatternMaterial::kPaper;
  const auto poll = [&] { progress.Poll(); };
  progress.BeginStage("Making seams equally long...", from, from + 0.4 * (to - from));
  const auto boundaries = Boundaries(charts);
  ParallelFor(static_cast<int>(charts.charts.size()), progress, [&](int c, const std::function<void()>& ask) {
    EqualizeSeams(boundaries[c], ask, charts.charts[c]);
  });

  progress.BeginStage("Simplifying outlines...", from + 0.4 * (to - from), from + 0.5 * (to - from));
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
