// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "common/surface_data.h"
#include "surface/surface_mesh.h"
#include "surface/surface_graph.h"

namespace dcharts {

inline Eigen::Vector3d PositionOf(const SurfaceData& data, int vertex) {
  return {data.vertices[vertex][0], data.vertices[vertex][1], data.vertices[vertex][2]};
}

/// The longest side of the box of the vertices that faces use.
inline double LongestSide(const SurfaceData& data) {
  Eigen::AlignedBox3d box;
  for (const auto& face : data.faces)
    for (int v : face) box.extend(PositionOf(data, v));
  return box.sizes().maxCoeff();
}

/// From the coordinates of a surface to those of the data it was made of, which it has moved and scaled.
class DataCoordinates {
 public:
  DataCoordinates(const SurfaceData& data, const SurfaceGraph<SurfaceMesh>& surface) {
    // The scale is that of any long distance.
    const int first = surface.Vertex(0);
    int farthest = first;
    const auto distance = [&](int v) { return (surface.Position(v) - surface.Position(first)).norm(); };
    for (int h = 0; h < surface.HalfEdgeCount(); ++h)
      if (distance(surface.Vertex(h)) > distance(farthest)) farthest = surface.Vertex(h);
    scale_ = (PositionOf(data, farthest) - PositionOf(data, first)).norm() / distance(farthest);
    offset_ = PositionOf(data, first) - scale_ * surface.Position(first);
  }

  double Scale() const { return scale_; }  ///< units of the data per unit of the surface
  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return scale_ * p + offset_; }

 private:
  double scale_ = 1;
  Eigen::Vector3d offset_{0, 0, 0};
};

}  // namespace dcharts
