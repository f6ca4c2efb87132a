// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "pattern/flat_charts.h"

namespace dcharts {

/// Where a chart bends round until its outline is nearer than `distance` (mm) to itself, outside the chart:
/// the two half-edges of the boundary that are nearest; nothing where there is room. Edges count that are far
/// from each other along the outline. `is_cut`: per half-edge, it is the side of a dart; what a dart's legs
/// have between them is no matter.
std::optional<std::pair<int, int>> NearItself(const FlatChart& chart, const std::vector<int>& boundary,
                                              const std::vector<char>& is_cut, double distance);

}  // namespace dcharts
