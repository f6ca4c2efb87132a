// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/chart_trial.h"

#include <utility>

#include "surface/open_chart.h"

namespace dcharts {

ChartPatch Opened(const ChartPatch& patch, double& cut_length) {
  ChartPatch open = patch;
  cut_length = 0;
  for (const bool handles : {true, false}) {
    const std::vector<int> cuts = handles ? CutsThatOpenHandles(open) : CutsThatJoinLoops(open, false);
    if (cuts.empty()) continue;
    for (int h : cuts) cut_length += open.Length(h);
    open = CutOpen(open, cuts);
  }
  return open;
}

namespace {

ChartTrial Try(const ChartPatch& patch, const TrialOptions& options, const std::function<void()>& poll,
               TrialFlattening* map) {
  ChartTrial trial;
  const ChartPatch open = Opened(patch, trial.cut_length);
  TrialFlattening flat = TrialFlatten(open.mesh, options, poll);
  trial.stretch = flat.l2_stretch;
  trial.energy = flat.energy;
  trial.overlaps = flat.overlaps >= kClearOverlap;
  trial.flat = flat.ok;
  if (map) *map = std::move(flat);
  return trial;
}

}  // namespace

ChartTrial TryChart(const ChartPatch& patch, double bound, const std::function<void()>& poll,
                    TrialFlattening* map) {
  TrialOptions options;
  options.l2_bound = bound;
  options.no_overlap = true;
  return Try(patch, options, poll, map);
}

ChartTrial TryChartWithOverlaps(const ChartPatch& patch, double bound, const std::function<void()>& poll) {
  TrialOptions options;
  options.l2_bound = bound;
  return Try(patch, options, poll, nullptr);
}

}  // namespace dcharts
