// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "planar/coarser_charts.h"
#include "planar/flatten.h"
#include "planar/trial_flatten.h"
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
  /// It only counts whether the goal is reached: no map is made of a chart that a coarser one, or its own
  /// with that one's darts, shows to stay above it.
  bool is_trial = false;
  bool is_of_large = false;  ///< the chart stands for a large one
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
  bool finished = true;  ///< `flat` is as the goal asks; false: by a quick map, or of a coarser chart
};

/// Without darts, and not flattened.
DartedChart Uncut(ChartPatch patch);

/// Pairs of its triangles that overlap, at most `most`.
size_t CountOverlaps(const DartedChart& chart, size_t most);
bool Overlaps(const DartedChart& chart);

/// Whether the worst stretch is a part of the goal: then charts are flattened with the finish that lowers it.
bool HasFinish(const DartGoal& goal);
bool Reached(const Flattening& flat, const DartGoal& goal);

/// As the atlas will have it. `start`, `coarser`: see FlattenOptions.
Flattening FlatWithFinish(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                          const Points2* start = nullptr, CoarserCharts* coarser = nullptr);
/// The quick way, without the finish; `start` may be null. Not ok when it is sure to stay above `l2_bound`.
Flattening FlatWithoutFinish(const ChartPatch& patch, const Points2* start, const std::function<void()>& poll,
                             CoarserCharts* coarser = nullptr,
                             double l2_bound = std::numeric_limits<double>::infinity());
/// The same of a trial that was made before.
Flattening FlatOf(TrialFlattening trial);
/// With the finish if the goal has it.
Flattening FlatAsAsked(const ChartPatch& patch, const DartGoal& goal, const std::function<void()>& poll,
                       CoarserCharts* coarser = nullptr);

}  // namespace dcharts
