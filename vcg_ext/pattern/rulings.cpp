// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

#include "common/pi.h"
#include "pattern/folds.h"
#include "pattern/outline.h"
#include "pattern/segments.h"
#include "planar/polygon.h"

namespace dcharts {
namespace {

/// The normals of a chart over its flat map, and where in the map a triangle is.
class NormalField {
 public:
  NormalField(const FlatChart& chart, double crease_degrees) : chart_(chart) {
    const Triangles& triangles = chart.mesh.triangles;
    low_ = chart.uv.colwise().minCoeff().transpose();
    const Point2 size = chart.uv.colwise().maxCoeff().transpose() - low_;
    cell_ = std::max(size.maxCoeff() / 64, 1e-6);
    columns_ = static_cast<int>(size.x() / cell_) + 1;
    rows_ = static_cast<int>(size.y() / cell_) + 1;
    cells_.resize(static_cast<size_t>(columns_) * rows_);
    Eigen::MatrixXd at_vertex = Eigen::MatrixXd::Zero(chart.uv.rows(), 3);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      Eigen::Vector3d p[3];
      Point2 a = chart.uv.row(triangles(t, 0)).transpose(), b = a;
      for (int k = 0; k < 3; ++k) {
        p[k] = chart.mesh.positions.row(triangles(t, k)).transpose();
        a = a.cwiseMin(chart.uv.row(triangles(t, k)).transpose());
        b = b.cwiseMax(chart.uv.row(triangles(t, k)).transpose());
      }
      const Eigen::Vector3d n = (p[1] - p[0]).cross(p[2] - p[0]);
      normal_.push_back(n.norm() > 0 ? Eigen::Vector3d(n.normalized()) : Eigen::Vector3d::Zero());
      for (int k = 0; k < 3; ++k) at_vertex.row(triangles(t, k)) += n.transpose();
      for (int y = Row(a.y()); y <= Row(b.y()); ++y)
        for (int x = Column(a.x()); x <= Column(b.x()); ++x)
          cells_[static_cast<size_t>(y) * columns_ + x].push_back(static_cast<int>(t));
    }
    at_vertex.rowwise().normalize();
    // How normals change over each triangle; across a crease that says nothing.
    const double crease = std::cos(crease_degrees * kPi / 180);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      Eigen::Matrix<double, 3, 2> change = Eigen::Matrix<double, 3, 2>::Zero();
      bool smooth = true;
      const Point2 uv[3] = {chart.uv.row(triangles(t, 0)), chart.uv.row(triangles(t, 1)),
                            chart.uv.row(triangles(t, 2))};
      const double twice = Orient(uv[0], uv[1], uv[2]);
      for (int k = 0; k < 3 && twice > 0; ++k) {
        const Point2 e = uv[(k + 2) % 3] - uv[(k + 1) % 3];
        change += at_vertex.row(triangles(t, k)).transpose() * Point2(-e.y(), e.x()).transpose() / twice;
        smooth = smooth && at_vertex.row(triangles(t, k)).dot(normal_[t]) > crease;
      }
      form_.push_back(smooth ? Eigen::Matrix2d(change.transpose() * change) : Eigen::Matrix2d::Zero());
    }
  }

  int TriangleAt(const Point2& p) const {
    if (p.x() < low_.x() || p.y() < low_.y()) return -1;
    const int x = static_cast<int>((p.x() - low_.x()) / cell_),
              y = static_cast<int>((p.y() - low_.y()) / cell_);
    if (x >= columns_ || y >= rows_) return -1;
    for (int t : cells_[static_cast<size_t>(y) * columns_ + x]) {
      const Point2 a = chart_.uv.row(chart_.mesh.triangles(t, 0)),
                   b = chart_.uv.row(chart_.mesh.triangles(t, 1)),
                   c = chart_.uv.row(chart_.mesh.triangles(t, 2));
      if (Orient(a, b, p) >= 0 && Orient(b, c, p) >= 0 && Orient(c, a, p) >= 0) return t;
    }
    return -1;
  }

  const Eigen::Vector3d& Normal(int triangle) const { return normal_[triangle]; }

  /// Sum of the squared change of the normal over the triangles near a point: its eigenvector of the smaller
  /// eigenvalue is the direction of the ruling.
  Eigen::Matrix2d FormNear(const Point2& p, double reach) const {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    double area = 0;
    for (int y = Row(p.y() - reach); y <= Row(p.y() + reach); ++y)
      for (int x = Column(p.x() - reach); x <= Column(p.x() + reach); ++x)
        for (int t : cells_[static_cast<size_t>(y) * columns_ + x]) {
          const Point2 a = chart_.uv.row(chart_.mesh.triangles(t, 0)),
                       b = chart_.uv.row(chart_.mesh.triangles(t, 1)),
                       c = chart_.uv.row(chart_.mesh.triangles(t, 2));
          if (((a + b + c) / 3 - p).norm() > reach) continue;
          const double weight = std::max(0.0, Orient(a, b, c));
          sum += weight * form_[t];
          area += weight;
        }
    return area > 0 ? Eigen::Matrix2d(sum / area) : sum;
  }

 private:
  int Column(double x) const { return std::clamp(static_cast<int>((x - low_.x()) / cell_), 0, columns_ - 1); }
  int Row(double y) const { return std::clamp(static_cast<int>((y - low_.y()) / cell_), 0, rows_ - 1); }

  const FlatChart& chart_;
  Point2 low_{0, 0};
  double cell_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> cells_;
  std::vector<Eigen::Vector3d> normal_;
  std::vector<Eigen::Matrix2d> form_;
};

// How far from p along d the normal stays within `most` (cosine) of the one at p.
double ReachAlong(const NormalField& field, const Point2& p, const Point2& d, double step, double most) {
  const Eigen::Vector3d& normal = field.Normal(field.TriangleAt(p));
  double reach = 0;
  for (;;) {
    const int t = field.TriangleAt(p + (reach + step) * d);
    if (t < 0 || field.Normal(t).dot(normal) < most) return reach;
    reach += step;
  }
}

}  // namespace

void AddRulings(const FlatChart& chart, double least_degrees, double least_spacing, Piece& piece) {
  const std::vector<Polyline> outline = OutlineOf(piece);
  if (outline.empty()) return;
  const NormalField field(chart, least_degrees);
  Point2 low = outline[0][0], high = low;
  for (const Point2& p : outline[0]) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  constexpr double kMostAcross = 200;  // a tent has no more lines than a toy
  const double spacing = std::max(least_spacing, (high - low).maxCoeff() / kMostAcross);
  constexpr double kLeastBend = 1.0 / 1000;  // 1 / mm: flatter than a circle of a metre's radius is flat
  constexpr double kOneWay = 0.3;            // the bend along a ruling over the one across it
  const double most = std::cos(4 * kPi / 180), step = spacing / 10;
  const auto is_near = [&](const Point2& p) {
    return std::any_of(piece.rulings.begin(), piece.rulings.end(),
                       [&](const Ruling& r) { return DistanceToSegment(p, r.from, r.to) < spacing; });
  };
  for (double y = low.y() + spacing / 2; y < high.y(); y += spacing / 2)
    for (double x = low.x() + spacing / 2; x < high.x(); x += spacing / 2) {
      const Point2 p(x, y);
      if (!IsInside(outline, p) || is_near(p) || field.TriangleAt(p) < 0) continue;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> bend(field.FormNear(p, spacing / 2));
      const double across = std::sqrt(std::max(0.0, bend.eigenvalues()[1])),
                   along = std::sqrt(std::max(0.0, bend.eigenvalues()[0]));
      if (across < kLeastBend || along > kOneWay * across) continue;
      const Point2 d = bend.eigenvectors().col(0);
      const Point2 from = p - ReachAlong(field, p, -d, step, most) * d,
                   to = p + ReachAlong(field, p, d, step, most) * d;
      for (const auto& [a, b] : ClipToRegion(from, to, outline))
        if ((b - a).norm() > spacing) piece.rulings.push_back({a, b});
    }
}

}  // namespace dcharts
