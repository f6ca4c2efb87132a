// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "pattern/flat_charts.h"

namespace dcharts {

/// The half-edges of a chart by their start and end.
std::map<std::pair<int, int>, int> HalfEdges(const FlatChart& chart);

/// Per half-edge the one on the other side of its edge; -1 at the boundary.
std::vector<int> OppositeHalfEdges(const FlatChart& chart);

}  // namespace dcharts
