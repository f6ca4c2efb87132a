// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planar/chart_mesh.h"

namespace dcharts {

/// Chains the boundary edges of a chart (`outline`: two rows per edge, its end points, each edge from where
/// another ends) to closed loops, counterclockwise around the chart, clockwise around its holes. Edges
/// without length are left out. False when the edges don't close up or nothing is left.
bool OutlineLoops(const Points2& outline, std::vector<std::vector<Eigen::Vector2d>>* loops);

/// A loop with fewer corners (after Douglas and Peucker), nowhere further than `tolerance` from the one
/// before; at least three corners stay when there are three.
std::vector<Eigen::Vector2d> Simplified(const std::vector<Eigen::Vector2d>& loop, double tolerance);

}  // namespace dcharts
