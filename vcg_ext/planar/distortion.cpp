// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/distortion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dcharts {

TriangleStretch StretchOfTriangle(const Eigen::Matrix3d& corners, const Eigen::Matrix<double, 3, 2>& uv) {
  TriangleStretch stretch;
  const Eigen::Vector3d e1 = (corners.row(1) - corners.row(0)).transpose();
  const Eigen::Vector3d e2 = (corners.row(2) - corners.row(0)).transpose();
  const Eigen::Vector2d f1 = (uv.row(1) - uv.row(0)).transpose(), f2 = (uv.row(2) - uv.row(0)).transpose();
  const double twice_area = e1.cross(e2).norm();
  const double twice_uv_area = f1.x() * f2.y() - f1.y() * f2.x();
  stretch.surface_area = 0.5 * twice_area;
  stretch.uv_area = 0.5 * twice_uv_area;
  if (!(twice_uv_area > 0)) {
    stretch.largest = stretch.smallest = std::numeric_limits<double>::infinity();
    return stretch;
  }
  // the partial derivatives of the map
  const Eigen::Vector3d by_u = (e1 * f2.y() - e2 * f1.y()) / twice_uv_area;
  const Eigen::Vector3d by_v = (e2 * f1.x() - e1 * f2.x()) / twice_uv_area;
  const double a = by_u.squaredNorm(), b = by_u.dot(by_v), c = by_v.squaredNorm();
  // of numbers near 1: std::hypot would take three times as long
  stretch.largest = std::sqrt(0.5 * (a + c + std::sqrt((a - c) * (a - c) + 4 * b * b)));
  stretch.smallest = stretch.largest > 0 ? twice_area / twice_uv_area / stretch.largest : 0;
  return stretch;
}

void StretchFigures::Add(const TriangleStretch& triangle, double area_floor) {
  if (!(triangle.surface_area > area_floor)) return;
  surface_area_ += triangle.surface_area;
  uv_area_ += std::abs(triangle.uv_area);
  if (!std::isfinite(triangle.largest)) {
    ++flipped_;
    return;
  }
  const double large = triangle.largest, small = triangle.smallest;
  const double sum = large * large + small * small;
  squares_ += triangle.surface_area * 0.5 * sum;
  if (sum > 0) shear_ += triangle.surface_area * (large - small) * (large - small) / sum;
  largest_ = std::max(largest_, large);
}

void StretchFigures::Scale(double surface_area_factor, double uv_area_factor) {
  const double square = surface_area_factor / uv_area_factor;
  surface_area_ *= surface_area_factor;
  uv_area_ *= uv_area_factor;
  squares_ *= surface_area_factor * square;
  shear_ *= surface_area_factor;
  largest_ *= std::sqrt(square);
}

double StretchFigures::L2() const {
  if (flipped_ > 0) return std::numeric_limits<double>::infinity();
  if (!(surface_area_ > 0)) return 1;
  return std::sqrt(squares_ / surface_area_) * std::sqrt(uv_area_ / surface_area_);
}

double StretchFigures::Linf() const {
  if (flipped_ > 0) return std::numeric_limits<double>::infinity();
  if (!(surface_area_ > 0)) return 1;
  return largest_ * std::sqrt(uv_area_ / surface_area_);
}

double StretchFigures::Shear() const { return surface_area_ > 0 ? shear_ / surface_area_ : 0; }

StretchFigures MeasureStretch(const ChartMesh& chart, const Points2& uv) {
  StretchFigures figures;
  if (chart.triangles.rows() == 0) return figures;
  // Measured at a size near 1, so that areas neither over- nor underflow.
  const Eigen::RowVector3d box = chart.positions.colwise().maxCoeff() - chart.positions.colwise().minCoeff();
  const Eigen::RowVector2d uv_box = uv.colwise().maxCoeff() - uv.colwise().minCoeff();
  const auto size_or_one = [](double size) { return size > 0 && std::isfinite(size) ? size : 1.0; };
  const double size = size_or_one(box.maxCoeff()), uv_size = size_or_one(uv_box.maxCoeff());
  const double area_floor = kAreaFloor * (box / size).squaredNorm();
  Eigen::Matrix3d corners;
  Eigen::Matrix<double, 3, 2> flat;
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    const Eigen::RowVector3d origin = chart.positions.row(chart.triangles(t, 0));
    const Eigen::RowVector2d uv_origin = uv.row(chart.triangles(t, 0));
    for (int k = 0; k < 3; ++k) {
      corners.row(k) = (chart.positions.row(chart.triangles(t, k)) - origin) / size;
      flat.row(k) = (uv.row(chart.triangles(t, k)) - uv_origin) / uv_size;
    }
    figures.Add(StretchOfTriangle(corners, flat), area_floor);
  }
  figures.Scale(size * size, uv_size * uv_size);
  return figures;
}

}  // namespace dcharts
