// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planar/overlap.h"

namespace dcharts {

/// Texcoords are rounded to multiples of 2^-24: all of them are exact in float32 within [0,1], and tests on
/// them are exact in integers.
constexpr double kTexcoordGrid = 16777216.0;

/// Rounding may flip a thin triangle. Moves its vertices by a few grid steps until every triangle has a
/// positive area; no other triangle loses its own. `triangles`: vertex indices, three per face. `x`, `y`:
/// grid positions per vertex. Returns the faces that could not be mended.
std::vector<int> MendRoundedTriangles(const std::vector<int>& triangles, std::vector<std::int32_t>& x,
                                      std::vector<std::int32_t>& y);

}  // namespace dcharts
