// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"

namespace dcharts {

/// The points times `factor`, as rows.
inline Points2 ToPoints(const PlanePoints& uv, double factor) {
  Points2 points(static_cast<Eigen::Index>(uv.size()), 2);
  for (std::size_t v = 0; v < uv.size(); ++v) {
    points.row(static_cast<Eigen::Index>(v)) << uv[v].real() * factor, uv[v].imag() * factor;
  }
  return points;
}

inline PlanePoints ToPlanePoints(const Points2& points) {
  PlanePoints uv(static_cast<std::size_t>(points.rows()));
  for (std::size_t v = 0; v < uv.size(); ++v) {
    const Eigen::Index row = static_cast<Eigen::Index>(v);
    uv[v] = {points(row, 0), points(row, 1)};
  }
  return uv;
}

}  // namespace dcharts
