// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "planar/flatten.h"
#include "surface/chart_patch.h"

namespace dcharts {

/// What darts are to reach.
struct DartGoal {
  double l2_stretch = 1;    ///< of the chart at its own scale
  double linf_stretch = 1;  ///< the same
  double longest = 0;       ///< bound on a dart's length, model units
  double unit = 1;          ///< what lengths of cuts are measured by, model units
};

/// A chart with its darts, flattened.
struct DartedChart {
  std::vector<int> edges;  ///< half-edges of the patch to cut, one per edge
  int count = 0;           ///< darts
  ChartPatch patch;        ///< cut open
  Flattening flat;         ///< of `patch`
};

/// Darts by measured stretch: flattens the chart, cuts from the border to the place that is stretched most,
/// and flattens it again, until the goal is reached. A dart that doesn't help, or makes the chart overlap
/// itself, is taken back. The patch must be one that can be flattened. `poll` may throw to stop the work.
DartedChart CutStretchDarts(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll);

}  // namespace dcharts
