// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pattern/pattern.h"

namespace dcharts {

/// Corners of regions are on a grid, so that what is computed of them is exact.
constexpr double kGridPerMm = 4096;

/// A connected part of the plane: the outer loop counterclockwise, holes clockwise. |coordinates| <= 131 m:
/// what lies beyond is refused by all functions here with an Error.
using Region = std::vector<Polyline>;

/// What any of the regions covers, as regions apart from each other, the largest first.
std::vector<Region> UnionOf(const std::vector<Region>& regions);

/// What both have in common, mm^2: exactly 0 where regions with corners on the grid only touch.
double CommonArea(const std::vector<Region>& a, const std::vector<Region>& b);

/// All that is within `distance` (mm, > 0) of the region. Corners stay corners, sharp ones (below 60 degrees)
/// are rounded.
std::vector<Region> Widened(const Region& region, double distance);

/// The point of the grid next to p.
Point2 OnRegionGrid(const Point2& p);

}  // namespace dcharts
