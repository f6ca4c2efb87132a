// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/chart_trial.h"

#include "planar/trial_flatten.h"
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

ChartTrial TryChart(const ChartPatch& patch, double bound, const std::function<void()>& poll) {
  ChartTrial trial;
  const ChartPatch open = Opened(patch, trial.cut_length);
  TrialOptions options;
  options.l2_bound = bound;
  options.no_overlap = true;
  const TrialFlattening flat = TrialFlatten(open.mesh, options, poll);
  trial.stretch = flat.l2_stretch;
  trial.energy = flat.energy;
  trial.overlaps = flat.overlaps >= kClearOverlap;
  trial.flat = flat.ok;
  return trial;
}

}  // namespace dcharts
