// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "surface/chart_patch.h"

namespace dcharts {

/// What it would cost to have a patch as a chart of the atlas.
struct ChartTrial {
  bool flat = false;      ///< it can be flattened within the bound, and doesn't overlap itself then
  double stretch = 0;     ///< L2 stretch at the chart's own scale, >= 1; 0 when there is no map at all
  double cut_length = 0;  ///< of the cuts it needs to lie flat, model units

  /// Its part in the L2 stretch of an atlas less 1, times the atlas's area: area (stretch^2 - 1) / 2.
  double Energy(double area) const { return area * (stretch * stretch - 1) / 2; }
};

/// Opens the patch as D-Charts: Cut would and flattens it with least stretch, whatever method the atlas will
/// have. Is not flat when the L2 stretch is sure to stay above `bound`. `poll` may throw to stop the work.
ChartTrial TryChart(const ChartPatch& patch, double bound, const std::function<void()>& poll);

}  // namespace dcharts
