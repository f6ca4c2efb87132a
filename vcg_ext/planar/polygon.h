// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace dcharts {

/// Signed area of a closed polyline: positive when counterclockwise; 0 without corners.
double SignedArea(const std::vector<Eigen::Vector2d>& loop);

/// Whether p lies within a closed polyline (even-odd).
bool IsInside(const std::vector<Eigen::Vector2d>& loop, const Eigen::Vector2d& p);

/// Whether p lies in a region with these loops as its boundary (even-odd).
bool IsInside(const std::vector<std::vector<Eigen::Vector2d>>& loops, const Eigen::Vector2d& p);

}  // namespace dcharts
