// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/darted_chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planar/overlap.h"

namespace dcharts {

// Member by member: GCC 12 destroys what a braced list has made twice when the memory ends in the midst of
// it.
DartedChart Uncut(ChartPatch patch) {
  DartedChart chart;
  chart.patch = std::move(patch);
  return chart;
}

size_t CountOverlaps(const DartedChart& chart, size_t most) {
  return OverlapsInMap(chart.flat.uv, chart.patch.mesh.triangles, most).size();
}

bool Overlaps(const DartedChart& chart) { return CountOverlaps(chart, 1) > 0; }

bool HasFinish(const DartGoal& goal) { return std::isfinite(goal.linf_stretch); }

bool Reached(const Flattening& flat, const DartGoal& goal) {
  return flat.l2_stretch <= goal.l2_stretch && flat.linf_stretch <= goal.linf_stretch;
}

Flattening FlatWithFinish(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                          const Points2* start, CoarserCharts* coarser) {
  FlattenOptions options;
  options.start = start;
  options.coarser = coarser;
  options.l2_bound = std::max(goal.l2_stretch, goal.l2_bound);
  return Flatten(patch.mesh, options, poll);
}

Flattening FlatWithoutFinish(const ChartPatch& patch, const Points2* start, const std::function<void()>& poll,
                             CoarserCharts* coarser, double l2_bound) {
  TrialOptions options;
  options.l2_bound = l2_bound;
  options.coarser = coarser;
  options.start = start;
  return FlatOf(TrialFlatten(patch.mesh, options, poll));
}

Flattening FlatOf(TrialFlattening trial) {
  Flattening flat;
  flat.ok = trial.ok;
  flat.why = std::move(trial.why);
  flat.uv = std::move(trial.uv);
  flat.l2_stretch = trial.l2_stretch;
  flat.linf_stretch = trial.linf_stretch;
  return flat;
}

Flattening FlatAsAsked(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                       CoarserCharts* coarser) {
  return HasFinish(goal) ? FlatWithFinish(patch, goal, poll, nullptr, coarser)
                         : FlatWithoutFinish(patch, nullptr, poll, coarser);
}

}  // namespace dcharts
