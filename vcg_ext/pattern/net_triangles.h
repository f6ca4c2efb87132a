// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "pattern/pattern.h"

namespace dcharts {

/// Triangulates a region without further points. `loops`: the outer one counterclockwise, holes clockwise,
/// none crossing. Returns counterclockwise triangles of the loops' points, numbered loop by loop. Ears are
/// cut off, the best shaped first, after holes were joined to the outer loop by bridges.
std::vector<std::array<int, 3>> NetTriangles(const std::vector<Polyline>& loops);

}  // namespace dcharts
