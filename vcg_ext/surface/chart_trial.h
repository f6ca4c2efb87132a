// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "planar/trial_flatten.h"
#include "surface/chart_patch.h"

namespace dcharts {

/// What it would cost to have a patch as a chart of the atlas.
struct ChartTrial {
  bool flat = false;      ///< it can be flattened within the bound, and doesn't overlap itself then
  bool overlaps = false;  ///< clearly: so will whatever holds this patch
  double stretch = 0;     ///< L2 stretch at the chart's own scale, >= 1; 0 when there is no map at all
  double energy = 0;      ///< symmetric Dirichlet / 4 - 1, mean over the area, >= 0
  double cut_length = 0;  ///< of the cuts it needs to lie flat, model units
};

/// The patch opened as D-Charts: Cut does before it looks for darts: no handle, and loops joined where they
/// would not lie flat. `cut_length` is what that takes, model units.
ChartPatch Opened(const ChartPatch& patch, double& cut_length);

/// Opens the patch and flattens it with least stretch, whatever method the atlas will have. Is not flat when
/// the L2 stretch is sure to stay above `bound`. `poll` may throw to stop the work. `map`, if not null, is
/// set to that of the opened patch.
ChartTrial TryChart(const ChartPatch& patch, double bound, const std::function<void()>& poll,
                    TrialFlattening* map = nullptr);

/// The same, but whether it overlaps itself is not asked.
ChartTrial TryChartWithOverlaps(const ChartPatch& patch, double bound, const std::function<void()>& poll);

}  // namespace dcharts
