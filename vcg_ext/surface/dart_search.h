// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "surface/darted_chart.h"

namespace dcharts {

/// Darts one by one, each from the border to the place of a flattened chart that is stretched most, until the
/// goal is reached or none helps. A dart that doesn't help, or makes the chart overlap itself, is taken back.
/// `poll` may throw.
void SearchDarts(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart);

}  // namespace dcharts
