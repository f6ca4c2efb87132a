// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/stretch_darts.h"

#include <chrono>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "common/work_ahead.h"
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

// The darts of a coarser chart. It may lap over itself: that doesn't tell whether the finer one does.
DartedChart CutCoarserChart(const ChartPatch& patch, const DartGoal& goal,
                            const std::function<void()>& poll) {
  DartedChart chart = CutStretchDarts(patch, goal, poll);
  if (chart.count > 0 || !HasFinish(goal) || !(chart.flat.l2_stretch > goal.l2_stretch)) return chart;
  return CutStretchDarts(patch, ForMeanStretch(goal), poll);
}

// Whether darts are looked for on a coarser chart.
bool GoesByCoarser(const ChartPatch& patch, const DartGoal& goal) {
  constexpr int kManyForTrial = 16000;
  return IsLargeChart(patch.mesh) || (goal.is_trial && patch.mesh.triangles.rows() >= kManyForTrial);
}

// A large chart gets the darts that a coarser one gets, `few` of `coarser`: each to the same vertex, along
// the shortest way there is here. It is not flattened: `flat` has the figures of the coarser one. `coarser`:
// of the patch.
DartedChart CutLargeChart(const ChartPatch& patch, const FewTriangles& few, const DartGoal& goal,
                          const std::function<void()>& poll, const std::shared_ptr<CoarserCharts>& coarser) {
  constexpr double kHopeless = 1.2;  // of the goal's L2 - 1
  if (poll) poll();
  DartedChart chart = Uncut(patch);
  if (!IsLargeChart(few.mesh)) {
    ChartPatch small{few.source_face, few.mesh, few.opposite};
    for (int v = 0; v < small.VertexCount(); ++v)
      small.mesh.positions.row(v) = patch.mesh.positions.row(few.source_vertex[v]);
    DartGoal goal_of_small = goal;
    goal_of_small.is_of_large = true;
    const DartedChart darted = CutCoarserChart(small, goal_of_small, poll);
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
    chart.flat.ok = darted.flat.ok;
    chart.flat.l2_stretch = darted.flat.l2_stretch;
    chart.flat.linf_stretch = darted.flat.linf_stretch;
  }
  chart.coarser = chart.count > 0 ? std::make_shared<CoarserCharts>(Normalized(chart.patch.mesh)) : coarser;
  chart.finished = false;
  return chart;
}

// Without darts, flattened as asked.
DartedChart FlatUncut(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                      const KnownOfChart& known) {
  DartedChart chart = Uncut(patch);
  chart.coarser = known.coarser;
  chart.flat = known.flat ? *known.flat : FlatAsAsked(patch, goal, poll, known.coarser.get());
  chart.l2_uncut = chart.flat.l2_stretch;
  return chart;
}

// A large chart: all darts, by the figures of a coarser one, or else by its own. Which darts there are hangs
// on how coarse that is.
DartedChart CutLargeUnfinished(const ChartPatch& patch, const DartGoal& goal,
                               const std::function<void()>& poll, const KnownOfChart& known) {
  const FewTriangles &few = known.coarser->ForTrials(poll), &more = known.coarser->LastQuarter(poll);
  constexpr double kFiner = 1.2;
  const bool may_try_again = goal.may_give_up && static_cast<double>(more.mesh.triangles.rows()) >=
                                                     kFiner * static_cast<double>(few.mesh.triangles.rows());
  DartedChart by_more;
  WorkAhead second_try({[&](const Poll& poll_ahead) {
    by_more = CutLargeChart(patch, more, goal, poll_ahead, known.coarser);
  }});
  // A first try that lasts seldom succeeds.
  constexpr std::chrono::milliseconds kPatience(200);
  const Poll poll_first = may_try_again ? second_try.BeginningAfter(kPatience, poll) : poll;
  DartedChart best;
  for (const bool again : {false, true}) {
    if (again) second_try.Finish(1, poll);
    DartedChart chart =
        again ? std::move(by_more) : CutLargeChart(patch, few, goal, poll_first, known.coarser);
    if (chart.flat.ok && chart.flat.l2_stretch <= goal.l2_stretch) return chart;
    // What the coarser chart doesn't reach, this one may.
    if (chart.count > 0 && FinishDarts(goal, poll, chart)) {
      if (chart.flat.l2_stretch <= goal.l2_stretch) return chart;
      if (!best.flat.ok || chart.flat.l2_stretch < best.flat.l2_stretch) best = std::move(chart);
    } else if (!best.flat.ok) {
      best = std::move(chart);
    }
    if (!may_try_again) break;
  }
  return best.finished || goal.is_trial ? best : FlatUncut(patch, goal, poll, known);
}

// A chart with the darts that a coarser one gets, finished; nothing where it doesn't reach the goal. Which
// darts there are hangs on chance.
std::optional<DartedChart> CutAsCoarser(const ChartPatch& patch, const DartGoal& goal,
                                        const std::function<void()>& poll) {
  constexpr int kManyTriangles = 8000;
  if (patch.mesh.triangles.rows() < kManyTriangles) return std::nullopt;
  const auto coarser = std::make_shared<CoarserCharts>(Normalized(patch.mesh));
  DartedChart chart = CutLargeChart(patch, coarser->LastQuarter(poll), goal, poll, coarser);
  if (chart.count == 0 || !FinishDarts(goal, poll, chart) || !(chart.flat.l2_stretch <= goal.l2_stretch))
    return std::nullopt;
  return chart;
}

// All darts, or, where the mean stretch needs some, these alone, by the map of the last dart's trial; of a
// large chart all, by the figures of a coarser one. `known` must have the coarser charts of a large one.
DartedChart CutDartsUnfinished(const ChartPatch& patch, const DartGoal& goal,
                               const std::function<void()>& poll, const KnownOfChart& known) {
  if (GoesByCoarser(patch, goal)) return CutLargeUnfinished(patch, goal, poll, known);
  // A chart that needs them is not finished without.
  if (known.mean_darts && HasFinish(goal) && !HasConePoints(patch) &&
      IsAbove(goal, poll, patch, known.mean_darts->l2_uncut)) {
    DartedChart chart = *known.mean_darts;
    chart.finished = false;
    return chart;
  }
  DartedChart chart = FlatUncut(patch, goal, poll, known);
  if (!chart.flat.ok || CutConePoints(goal, poll, chart)) return chart;
  if (HasFinish(goal) && chart.flat.l2_stretch > goal.l2_stretch) {
    DartedChart darted = CutForMeanStretchAlone(goal, poll, patch, known.flat);
    const bool reached = darted.flat.ok && darted.flat.l2_stretch <= goal.l2_stretch;
    // One that may give up would be parted.
    if (!reached && goal.may_give_up)
      if (std::optional<DartedChart> other = CutAsCoarser(patch, goal, poll)) return std::move(*other);
    if (darted.count == 0) return chart;
    darted.finished = !reached;
    // What a quick map doesn't reach, the atlas's may.
    return !darted.finished || FinishDarts(goal, poll, darted) ? darted : chart;
  }
  SearchDarts(goal, poll, chart);
  return chart;
}

KnownOfChart WithCoarser(const ChartPatch& patch, const DartGoal& goal, KnownOfChart known) {
  if (GoesByCoarser(patch, goal) && !known.coarser)
    known.coarser = std::make_shared<CoarserCharts>(Normalized(patch.mesh));
  return known;
}

}  // namespace

DartedChart CutMeanDarts(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                         const KnownOfChart& known) {
  DartedChart chart = CutDartsUnfinished(patch, goal, poll, WithCoarser(patch, goal, known));
  if (chart.finished || IsLargeChart(patch.mesh)) return chart;
  // The map of a dart's trial may have twice the least stretch.
  Flattening better = FlatWithoutFinish(chart.patch, &chart.flat.uv, poll);
  if (better.ok) chart.flat = std::move(better);
  return chart;
}

bool AddMeanDarts(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart) {
  DartedChart darted;
  if (IsLargeChart(chart.patch.mesh)) {
    darted = CutLargeChart(chart.patch, chart.coarser->ForTrials(poll), goal, poll, chart.coarser);
    darted.edges.insert(darted.edges.begin(), chart.edges.begin(), chart.edges.end());
    darted.tips.insert(darted.tips.begin(), chart.tips.begin(), chart.tips.end());
    darted.count += chart.count;
  } else {
    darted = chart;
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
  finished.flat = FlatAsAsked(finished.patch, goal, poll, finished.coarser.get());
  if (!finished.flat.ok) return false;
  finished.finished = true;
  const bool is_large = IsLargeChart(chart.patch.mesh);
  // A large one without darts may overlap itself: Parameterize draws it apart, or cuts it.
  if ((finished.count > 0 || !is_large) && Overlaps(finished) && !DrawApart(goal, poll, finished))
    return false;
  if (!is_large && finished.flat.l2_stretch <= goal.l2_stretch) SearchDarts(goal, poll, finished);
  chart = std::move(finished);
  return true;
}

DartedChart CutStretchDarts(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                            const KnownOfChart& known) {
  const KnownOfChart all_known = WithCoarser(patch, goal, known);
  DartedChart chart = CutDartsUnfinished(patch, goal, poll, all_known);
  const bool may_do = !goal.is_trial || chart.flat.l2_stretch <= goal.l2_stretch;
  if (chart.finished || (may_do && (chart.count > 0 || !known.flat) && FinishDarts(goal, poll, chart)))
    return chart;
  return goal.is_trial ? Uncut(patch) : FlatUncut(patch, goal, poll, all_known);
}

}  // namespace dcharts
