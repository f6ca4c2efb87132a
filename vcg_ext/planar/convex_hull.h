// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dcharts {

/// The corners of the convex hull, counterclockwise from the leftmost one. Fewer than three where all points
/// are on a line.
std::vector<Eigen::Vector2d> ConvexHull(std::vector<Eigen::Vector2d> points);

}  // namespace dcharts
