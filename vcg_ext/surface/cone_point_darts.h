// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "surface/darted_chart.h"

namespace dcharts {

/// Whether a chart is flat or rolled everywhere but for some points at which it comes to a point.
bool HasConePoints(const ChartPatch& patch);

/// A dart to each cone point, when the chart has no stretch at all then and that is worth the length: one by
/// one they would not lower the worst stretch. False, and the chart is as it was, when they are of no use.
bool CutConePoints(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart);

}  // namespace dcharts
