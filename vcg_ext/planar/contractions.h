// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"

namespace dcharts {

/// TriangleContraction of a triangle of a map; 0 for slivers.
double ContractionOf(const Triangles& triangles, const RestShapes& shapes, const PlanePoints& uv,
                     Eigen::Index triangle);

/// Per vertex, whether it belongs to a triangle contracted by more than `bound`, or is within so many rings
/// of triangles around these. `contractions`: per triangle.
std::vector<char> NearContracted(const Triangles& triangles, const std::vector<double>& contractions,
                                 std::size_t vertex_count, double bound, int rings);

}  // namespace dcharts
