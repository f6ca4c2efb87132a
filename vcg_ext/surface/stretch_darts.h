// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "planar/coarser_charts.h"
#include "planar/flatten.h"
#include "surface/chart_patch.h"

namespace dcharts {

/// What darts are to reach.
struct DartGoal {
  double l2_stretch = 1;    ///< of the chart at its own scale
  double linf_stretch = 1;  ///< the same
  double l2_bound =
      1;               ///< what lowering the worst stretch may raise the L2 stretch to, if above `l2_stretch`
  double longest = 0;  ///< bound on a dart's length, model units
  int most_darts = 12;
  /// A large chart that a coarser one shows to stay above `l2_stretch` may be left unflattened.
  bool may_give_up = false;
  double unit =
      1;  ///< the length of dart for which the Linf stretch has to fall by kLinfPerUnit, model units
};

/// A chart with its darts, flattened.
struct DartedChart {
  std::vector<int> edges;  ///< half-edges of the patch to cut, one per edge
  int count = 0;           ///< darts
  std::vector<int> tips;   ///< of each cut, a half-edge of the patch that starts where it ends; in order
  ChartPatch patch;        ///< cut open
  Flattening flat;         ///< of `patch`
  std::shared_ptr<CoarserCharts> coarser;  ///< those of `patch`, when it is a large chart
  double l2_uncut = 1;                     ///< the L2 stretch before, by a quick map
};

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

}  // namespace dcharts
