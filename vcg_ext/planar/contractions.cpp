// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/contractions.h"

#include "planar/stretch_energy.h"

namespace dcharts {

double ContractionOf(const Triangles& triangles, const RestShapes& shapes, const PlanePoints& uv,
                     Eigen::Index triangle) {
  const RestShape& shape = shapes[static_cast<std::size_t>(triangle)];
  if (shape.sliver) return 0;
  const Complex z0 = uv[static_cast<std::size_t>(triangles(triangle, 0))];
  return TriangleContraction(shape, uv[static_cast<std::size_t>(triangles(triangle, 1))] - z0,
                             uv[static_cast<std::size_t>(triangles(triangle, 2))] - z0);
}

std::vector<char> NearContracted(const Triangles& triangles, const std::vector<double>& contractions,
                                 std::size_t vertex_count, double bound, int rings) {
  std::vector<char> near(vertex_count, 0);
  const auto corner = [&](Eigen::Index t, int i) { return static_cast<std::size_t>(triangles(t, i)); };
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    if (contractions[static_cast<std::size_t>(t)] > bound)
      for (int i = 0; i < 3; ++i) near[corner(t, i)] = 1;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<char> before = near;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
      if (before[corner(t, 0)] || before[corner(t, 1)] || before[corner(t, 2)])
        for (int i = 0; i < 3; ++i) near[corner(t, i)] = 1;
  }
  return near;
}

}  // namespace dcharts
