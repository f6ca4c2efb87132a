// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pattern/pattern.h"

namespace dcharts {

struct Circle {
  Point2 middle{0, 0};
  double radius = 0;
};

/// The largest circle in a region with these loops as its boundary, to within 1 % of the region's size.
Circle LargestCircle(const std::vector<Polyline>& loops);

}  // namespace dcharts
