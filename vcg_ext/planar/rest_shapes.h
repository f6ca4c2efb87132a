// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"

namespace dcharts {

/// The shape a triangle wants to have in the plane, as the coefficients that turn the edges e1 = z1 - z0 and
/// e2 = z2 - z0 of its image into the map's alpha = a1 e1 + a2 e2 and beta = conj(a1) e1 + conj(a2) e2.
struct RestShape {
  Complex a1, a2;
  double twice_area = 0;  ///< of the rest shape, > 0
  double weight = 0;      ///< share in the chart's energy; those of a chart sum up to about 1
  bool sliver = false;    ///< the rest shape is not the triangle's own, see RestShapesOf
};
using RestShapes = std::vector<RestShape>;

/// Rest shape of a triangle with the given corners in the plane, which must have a positive area.
RestShape ShapeFromCorners(const Complex& r0, const Complex& r1, const Complex& r2);

/// What triangles of a chart are held to, lengths at a total area of about 1.
struct RestFloors {
  double mean_area = 0;
  double height = 0;  ///< least height of a rest shape
  double edge = 0;    ///< least longest edge
};
RestFloors RestFloorsOf(const ChartMesh& chart);

/// The rest shape of one triangle in space, see RestShapesOf.
RestShape RestShapeOf(const Eigen::Vector3d corner[3], const RestFloors& floors);

/// Rest shapes of the chart's triangles, which must have a total area of about 1. Triangles too thin or too
/// small to give a direction, or to keep their orientation in float32, get a floored height or size and a
/// small weight, and are marked as slivers.
RestShapes RestShapesOf(const ChartMesh& chart);

/// Lets every sliver be content with the shape it has in `uv`, where it must have a positive area, if only
/// that is not too thin for float32.
void RelaxSlivers(const Triangles& triangles, const PlanePoints& uv, RestShapes& shapes);

/// Makes slivers with the given weight (1 = that of a mean triangle) of the triangles too thin in `uv` to
/// keep their orientation in float32, with thicker rest shapes; returns their number.
int ThickenThinTriangles(const Triangles& triangles, const PlanePoints& uv, double weight,
                         RestShapes& shapes);

}  // namespace dcharts
