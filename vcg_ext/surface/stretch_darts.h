// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "planar/coarser_charts.h"
#include "planar/flatten.h"
#include "surface/chart_patch.h"
#include "surface/darted_chart.h"

namespace dcharts {

/// What is known of a chart before darts are looked for: it saves time and changes nothing. All may be null.
struct KnownOfChart {
  const Flattening* flat = nullptr;  ///< by the same goal
  /// What CutStretchDarts makes of the chart by the same goal without a bound on the Linf stretch, where it
  /// reaches that.
  const DartedChart* mean_darts = nullptr;
  std::shared_ptr<CoarserCharts> coarser{};
};

/// Darts by measured stretch: flattens the chart, cuts from the border to the place that is stretched most,
/// and flattens it again, until the goal is reached (without the finish that lowers the worst stretch when
/// that is no part of the goal). A dart that doesn't help, or makes the chart overlap itself, is taken back.
/// A chart that is developable but for some points gets a dart to each of these. The patch must be one that
/// can be flattened. `poll` may throw to stop the work.
DartedChart CutStretchDarts(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                            const KnownOfChart& known = {});

/// The first half of it, for those who may want more darts before the finish, which takes as long as all
/// else: where the mean stretch needs darts and these bring a quick map within the goal, these alone. A large
/// chart gets all its darts, but isn't flattened where a coarser one is within the goal: `flat` has its
/// figures and no UVs. `finished` is false then. All other charts are as CutStretchDarts makes them.
DartedChart CutMeanDarts(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                         const KnownOfChart& known = {});

/// More darts, for the mean stretch alone (of a large chart for both). False when there are none that lower
/// it; else the chart has to be finished again.
bool AddMeanDarts(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart);

/// The other half: flattens a chart and cuts those darts that its worst stretch needs. False, and the chart
/// is as it was, when there is no map, or darts make it overlap itself; it may be above the goal.
bool FinishDarts(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart);

}  // namespace dcharts
