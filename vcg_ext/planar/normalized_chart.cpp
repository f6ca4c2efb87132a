// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/normalized_chart.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planar/distortion.h"

namespace dcharts {

NormalizedChart Normalized(const ChartMesh& chart) {
  NormalizedChart normalized;
  normalized.mesh = chart;
  Points3& positions = normalized.mesh.positions;
  const Eigen::RowVector3d low = positions.colwise().minCoeff(), high = positions.colwise().maxCoeff();
  normalized.extent = (0.5 * high - 0.5 * low).maxCoeff();
  if (!(normalized.extent > 0)) return normalized;
  positions = ((positions.rowwise() - (0.5 * low + 0.5 * high)) / normalized.extent).eval();
  double area = 0, largest = 0;
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    const Eigen::RowVector3d corner = positions.row(chart.triangles(t, 0));
    const Eigen::Vector3d e1 = (positions.row(chart.triangles(t, 1)) - corner).transpose();
    const Eigen::Vector3d e2 = (positions.row(chart.triangles(t, 2)) - corner).transpose();
    const double triangle_area = 0.5 * e1.cross(e2).norm();
    area += triangle_area;
    largest = std::max(largest, triangle_area);
  }
  const Eigen::RowVector3d box = (high - low) / normalized.extent;
  if (!(largest > kAreaFloor * box.squaredNorm())) return normalized;
  positions /= std::sqrt(area);
  normalized.scale = normalized.extent * std::sqrt(area);
  return normalized;
}

}  // namespace dcharts
