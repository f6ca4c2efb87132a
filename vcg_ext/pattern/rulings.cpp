// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

#include "common/pi.h"
#include "pattern/folds.h"
#include "pattern/half_edges.h"
#include "pattern/outline.h"
#include "pattern/segments.h"
#include "planar/polygon.h"

namespace dcharts {
namespace {

/// The normals and the bends of a chart over its flat map, and where in the map a triangle is.
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
      for (int y = Row(a.y()); y <= Row(b.y()); ++y)
        for (int x = Column(a.x()); x <= Column(b.x()); ++x)
          cells_[static_cast<size_t>(y) * columns_ + x].push_back(static_cast<int>(t));
    }
    bend_.assign(triangles.rows(), Eigen::Matrix2d::Zero());
    const std::vector<int> opposite = OppositeHalfEdges(chart);
    for (int h = 0; h < static_cast<int>(opposite.size()); ++h)
      if (opposite[h] > h) AddBend(h, opposite[h], crease_degrees);
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

  /// How the surface bends near a point, 1 / mm: a ruling is an eigenvector of the eigenvalue nearer to 0.
  Eigen::Matrix2d BendNear(const Point2& p, double reach) const {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    double area = 0;
    for (int y = Row(p.y() - reach); y <= Row(p.y() + reach); ++y)
      for (int x = Column(p.x() - reach); x <= Column(p.x() + reach); ++x)
        for (int t : cells_[static_cast<size_t>(y) * columns_ + x]) {
          const Point2 a = chart_.uv.row(chart_.mesh.triangles(t, 0)),
                       b = chart_.uv.row(chart_.mesh.triangles(t, 1)),
                       c = chart_.uv.row(chart_.mesh.triangles(t, 2));
          if (((a + b + c) / 3 - p).norm() > reach) continue;
          sum += bend_[t];
          area += std::max(0.0, Orient(a, b, c)) / 2;
        }
    return area > 0 ? Eigen::Matrix2d(sum / area) : sum;
  }

 private:
  // A triangulated surface bends at its edges, across them (Cohen-Steiner, Morvan 2003); so the flat sides of
  // a prism do not bend however they are triangulated. A crease says nothing of what is beside it.
  void AddBend(int h, int opposite, double crease_degrees) {
    const Eigen::Vector3d &m = normal_[h / 3], &n = normal_[opposite / 3];
    if (m.isZero() || n.isZero()) return;
    const Eigen::Vector3d edge =
        (chart_.mesh.positions.row(EndOf(chart_, h)) - chart_.mesh.positions.row(StartOf(chart_, h)))
            .transpose();
    const double angle = std::atan2(m.cross(n).dot(edge.normalized()), m.dot(n));
    if (std::abs(angle) >= crease_degrees * kPi / 180) return;
    const Point2 along = (chart_.uv.row(EndOf(chart_, h)) - chart_.uv.row(StartOf(chart_, h))).transpose();
    if (!(along.norm() > 0)) return;
    const Point2 across = Point2(-along.y(), along.x()).normalized();
    const Eigen::Matrix2d bend = angle * along.norm() * across * across.transpose();
    for (int t : {h / 3, opposite / 3}) bend_[t] += bend / 2;
  }

  int Column(double x) const { return std::clamp(static_cast<int>((x - low_.x()) / cell_), 0, columns_ - 1); }
  int Row(double y) const { return std::clamp(static_cast<int>((y - low_.y()) / cell_), 0, rows_ - 1); }

  const FlatChart& chart_;
  Point2 low_{0, 0};
  double cell_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> cells_;
  std::vector<Eigen::Vector3d> normal_;
  std::vector<Eigen::Matrix2d> bend_;  // of each triangle, times its area
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
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> bend(field.BendNear(p, spacing / 2));
      const int ruling = std::abs(bend.eigenvalues()[0]) < std::abs(bend.eigenvalues()[1]) ? 0 : 1;
      const double across = std::abs(bend.eigenvalues()[1 - ruling]),
                   along = std::abs(bend.eigenvalues()[ruling]);
      if (across < kLeastBend || along > kOneWay * across) continue;
      const Point2 d = bend.eigenvectors().col(ruling);
      const Point2 from = p - ReachAlong(field, p, -d, step, most) * d,
                   to = p + ReachAlong(field, p, d, step, most) * d;
      for (const auto& [a, b] : ClipToRegion(from, to, outline))
        if ((b - a).norm() > spacing) piece.rulings.push_back({a, b});
    }
}

}  // namespace dcharts
