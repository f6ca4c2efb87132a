// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace dcharts::shapes {

/// Triangles of a flat region, counter-clockwise.
struct PlanarMesh {
  std::vector<Eigen::Vector2d> points;  ///< all points of all loops in their order, then the inner ones
  std::vector<std::array<int, 3>> faces;
};

/// Fills the region within `loops` (closed polygons, the first outside, the others holes; either direction)
/// with nearly equilateral triangles. The edges of the loops stay as they are: they should be about
/// `edge_length` long, and loops that come closer to each other than that need shorter ones. Throws
/// std::invalid_argument when an edge of a loop would be lost.
PlanarMesh FillPolygon(const std::vector<std::vector<Eigen::Vector2d>>& loops, double edge_length);

}  // namespace dcharts::shapes
