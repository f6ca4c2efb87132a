// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planar/chart_mesh.h"

namespace dcharts {

/// Singular values of the map from one triangle's UVs to the surface, and both its areas.
struct TriangleStretch {
  double largest = 0, smallest = 0;  ///< infinite when the UV area isn't positive
  double surface_area = 0;           ///< model units squared
  double uv_area = 0;                ///< signed
};

/// `corners` and `uv`: three corners, one per row.
TriangleStretch StretchOfTriangle(const Eigen::Matrix3d& corners, const Eigen::Matrix<double, 3, 2>& uv);

/// Sums over triangles from which the figures follow, whatever the scale of the UVs. Add() them one by one.
class StretchFigures {
 public:
  /// Triangles with an area below `area_floor` count nowhere.
  void Add(const TriangleStretch& triangle, double area_floor);

  /// For figures added in other units: both areas times these factors.
  void Scale(double surface_area_factor, double uv_area_factor);

  double SurfaceArea() const { return surface_area_; }
  double UvArea() const { return uv_area_; }  ///< of the triangles that count, sum of |area|
  int FlippedOrDegenerate() const { return flipped_; }

  /// Root mean square stretch of [SSGH01] with the UV area scaled to the surface area: 1 when isometric,
  /// infinite with a UV-degenerate or flipped triangle, 1 when no triangle counts.
  double L2() const;
  /// Largest singular value UV -> surface at that scale; as L2 otherwise.
  double Linf() const;
  /// Area-weighted mean of (G - g)^2 / (G^2 + g^2), G >= g the singular values: 0 when conformal, at most 1.
  double Shear() const;

 private:
  double surface_area_ = 0, uv_area_ = 0;
  double squares_ = 0, shear_ = 0, largest_ = 0;
  int flipped_ = 0;
};

/// The share of the squared bounding box diagonal below which a triangle's area is rounding noise.
constexpr double kAreaFloor = 1e-14;

/// The figures of a whole chart. `uv`: #V by 2.
StretchFigures MeasureStretch(const ChartMesh& chart, const Points2& uv);

}  // namespace dcharts
