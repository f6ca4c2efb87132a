// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/stretch_darts.h"

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "planar/lay_apart.h"
#include "planar/normalized_chart.h"
#include "surface/cone_point_darts.h"
#include "surface/dart_search.h"
#include "surface/patch_paths.h"

namespace dcharts {
namespace {

// Of a chart that laps over itself a little.
bool DrawApart(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart) {
  std::optional<ApartMap> apart = LayApart(chart.patch.mesh, chart.flat.uv, goal.l2_stretch,
                                           ApartMapFor::kAtlas, poll, chart.coarser.get());
  if (!apart) return false;
  chart.flat.uv = std::move(apart->uv);
  chart.flat.l2_stretch = apart->l2_stretch;
  chart.flat.linf_stretch = apart->linf_stretch;
  return true;
}

// The same without a bound on the worst stretch.
DartGoal ForMeanStretch(DartGoal goal) {
  goal.linf_stretch = std::numeric_limits<double>::infinity();
  return goal;
}

// What CutStretchDarts makes of it when only the mean stretch counts, or as far as it comes.
DartedChart CutForMeanStretchAlone(const DartGoal& goal, const std::function<void()>& poll,
                                   const ChartPatch& patch, const Flattening* known) {
  DartedChart darted = Uncut(patch);
  // From no start where none is known: from that of the finish the search would not end at the darts that a
  // trial of the chart has shown.
  darted.flat = FlatWithoutFinish(patch, known ? &known->uv : nullptr, poll);
  SearchDarts(ForMeanStretch(goal), poll, darted);
  return darted;
}

// Whether the chart is above the goal when it is flattened as well as that goes, which a quick map that is
// a little above it doesn't tell.
bool IsAbove(const DartGoal& goal, const std::function<void()>& poll, const ChartPatch& patch,
             double l2_of_quick_map) {
  constexpr double kFarAbove = 1.5, kSurely = 1.02;  // of L2 - 1
  if (l2_of_quick_map - 1 > kFarAbove * (goal.l2_stretch - 1)) return true;
  FlattenOptions options;
  options.linf_finish = false;
  const Flattening flat = Flatten(patch.mesh, options, poll);
  return flat.ok && flat.l2_stretch - 1 > kSurely * (goal.l2_stretch - 1);
}

// A large chart gets the darts that a coarser one gets: each to the same vertex, along the shortest way there
// is here. A chart without them when they don't serve here.
DartedChart CutLargeChart(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                          const KnownOfChart& known) {
  constexpr double kHopeless = 1.2;  // of the goal's L2 - 1
  if (poll) poll();
  const std::shared_ptr<CoarserCharts> coarser =
      known.coarser ? known.coarser : std::make_shared<CoarserCharts>(Normalized(patch.mesh));
  DartedChart chart = Uncut(patch);
  const FewTriangles& few = coarser->ForTrials(poll);
  if (!IsLargeChart(few.mesh)) {
    ChartPatch small{few.source_face, few.mesh, few.opposite};
    for (int v = 0; v < small.VertexCount(); ++v)
      small.mesh.positions.row(v) = patch.mesh.positions.row(few.source_vertex[v]);
    const DartedChart darted = CutStretchDarts(small, goal, poll);
    if (goal.may_give_up && !(darted.flat.l2_stretch - 1 <= kHopeless * (goal.l2_stretch - 1))) {
      chart.flat.why = "A coarser chart is stretched too much.";
      return chart;
    }
    std::vector<int> corner_at(patch.VertexCount());  // that starts at a vertex
    for (int h = 0; h < patch.HalfEdgeCount(); ++h) corner_at[patch.Vertex(h)] = h;
    for (int tip : darted.tips) {
      if (poll) poll();
      PatchPaths paths(chart.patch);
      paths.Run(paths.BoundaryVertices(), true);
      chart.tips.push_back(corner_at[few.source_vertex[small.Vertex(tip)]]);
      const std::vector<int> cut = paths.Path(chart.patch.Vertex(chart.tips.back()));
      chart.edges.insert(chart.edges.end(), cut.begin(), cut.end());
      chart.count += !cut.empty();
      chart.patch = CutOpen(chart.patch, cut);
    }
  }
  if (poll) poll();
  if (chart.count > 0) {
    chart.coarser = std::make_shared<CoarserCharts>(Normalized(chart.patch.mesh));
    chart.flat = FlatAsAsked(chart.patch, goal, poll, chart.coarser.get());
    if (chart.flat.ok && !Overlaps(chart)) return chart;
    chart = Uncut(patch);
  }
  chart.coarser = coarser;
  chart.flat = known.flat ? *known.flat : FlatAsAsked(patch, goal, poll, coarser.get());
  return chart;
}

// All darts, or, where the mean stretch needs some, these alone, by the map of the last dart's trial.
DartedChart CutDartsUnfinished(const ChartPatch& patch, const DartGoal& goal,
                               const std::function<void()>& poll, const KnownOfChart& known) {
  if (IsLargeChart(patch.mesh)) return CutLargeChart(patch, goal, poll, known);
  // A chart that needs them is not finished without.
  if (known.mean_darts && HasFinish(goal) && !HasConePoints(patch) &&
      IsAbove(goal, poll, patch, known.mean_darts->l2_uncut)) {
    DartedChart chart = *known.mean_darts;
    chart.finished = false;
    return chart;
  }
  DartedChart chart = Uncut(patch);
  chart.flat = known.flat ? *known.flat : FlatAsAsked(patch, goal, poll);
  chart.l2_uncut = chart.flat.l2_stretch;
  if (!chart.flat.ok || CutConePoints(goal, poll, chart)) return chart;
  if (HasFinish(goal) && chart.flat.l2_stretch > goal.l2_stretch) {
    DartedChart darted = CutForMeanStretchAlone(goal, poll, patch, known.flat);
    if (darted.count == 0) return chart;
    darted.finished = !(darted.flat.ok && darted.flat.l2_stretch <= goal.l2_stretch);
    // What a quick map doesn't reach, the atlas's may.
    return !darted.finished || FinishDarts(goal, poll, darted) ? darted : chart;
  }
  SearchDarts(goal, poll, chart);
  return chart;
}

}  // namespace

DartedChart CutMeanDarts(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                         const KnownOfChart& known) {
  DartedChart chart = CutDartsUnfinished(patch, goal, poll, known);
  if (chart.finished) return chart;
  // The map of a dart's trial may have twice the least stretch.
  Flattening better = FlatWithoutFinish(chart.patch, &chart.flat.uv, poll);
  if (better.ok) chart.flat = std::move(better);
  return chart;
}

bool AddMeanDarts(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart) {
  DartedChart darted = chart;
  if (IsLargeChart(chart.patch.mesh)) {
    DartedChart more = CutLargeChart(chart.patch, goal, poll, {&chart.flat, nullptr, chart.coarser});
    more.edges.insert(more.edges.begin(), chart.edges.begin(), chart.edges.end());
    more.tips.insert(more.tips.begin(), chart.tips.begin(), chart.tips.end());
    more.count += chart.count;
    darted = std::move(more);
  } else {
    if (darted.finished) darted.flat = FlatWithoutFinish(darted.patch, &chart.flat.uv, poll);
    SearchDarts(ForMeanStretch(goal), poll, darted);
    darted.finished = false;
  }
  if (darted.count == chart.count || !darted.flat.ok || !(darted.flat.l2_stretch < chart.flat.l2_stretch))
    return false;
  chart = std::move(darted);
  return true;
}

bool FinishDarts(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart) {
  DartedChart finished = chart;
  finished.flat = FlatWithFinish(finished.patch, goal, poll);
  if (!finished.flat.ok || (Overlaps(finished) && !DrawApart(goal, poll, finished))) return false;
  finished.finished = true;
  if (finished.flat.l2_stretch <= goal.l2_stretch) SearchDarts(goal, poll, finished);
  chart = std::move(finished);
  return true;
}

DartedChart CutStretchDarts(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                            const KnownOfChart& known) {
  DartedChart chart = CutDartsUnfinished(patch, goal, poll, known);
  if (chart.finished || FinishDarts(goal, poll, chart)) return chart;
  chart = Uncut(patch);
  chart.flat = known.flat ? *known.flat : FlatAsAsked(patch, goal, poll);
  chart.l2_uncut = chart.flat.l2_stretch;
  return chart;
}

}  // namespace dcharts
