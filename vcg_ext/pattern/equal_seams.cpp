// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/equal_seams.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include "pattern/segments.h"

namespace dcharts {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// The energy of one chart: that of its inside, and springs along the boundary.
class BoundaryFit {
 public:
  BoundaryFit(const FlatChart& chart, const std::vector<int>& boundary, KeepInside keep)
      : vertex_count_(static_cast<int>(chart.uv.rows())), keep_(keep), triangles_(chart.mesh.triangles) {
    double area = 0;
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
      rest_.push_back(RestOf(chart.mesh, t));
      area += rest_.back().area;
      if (keep == KeepInside::kAngles)
        AddConformalError(t);
      else
        AddStiffness(t);
    }
    for (int h : boundary) {
      Spring spring;
      spring.a = StartOf(chart, h);
      spring.b = EndOf(chart, h);
      spring.length = (chart.mesh.positions.row(spring.a) - chart.mesh.positions.row(spring.b)).norm();
      if (spring.length > 0) springs_.push_back(spring);
    }
    size_ = std::sqrt(area);
    // A little weight on every vertex's place holds the chart where it is.
    for (int k = 0; k < 2 * vertex_count_; ++k) inside_.emplace_back(k, k, 1e-9);
    matrix_.resize(2 * vertex_count_, 2 * vertex_count_);
    matrix_.setFromTriplets(inside_.begin(), inside_.end());
    inside_matrix_ = matrix_;
  }

  double Energy(const Eigen::VectorXd& x) const {
    double energy = 0.5 * x.dot(inside_matrix_ * x);
    if (keep_ == KeepInside::kLengths) energy += TurnedRest(x, nullptr);
    for (const Spring& s : springs_) {
      const double error = (At(x, s.b) - At(x, s.a)).norm() - s.length;
      energy += 0.5 * Stiffness(s) * error * error;
    }
    return energy;
  }

  double WorstError(const Eigen::VectorXd& x) const {
    double worst = 0;
    for (const Spring& s : springs_)
      worst = std::max(worst, std::abs((At(x, s.b) - At(x, s.a)).norm() / s.length - 1));
    return worst;
  }

  /// One step with a line search. False when it gained nothing.
  bool Step(Eigen::VectorXd& x) {
    Triplets entries = inside_;
    Eigen::VectorXd gradient = inside_matrix_ * x;
    if (keep_ == KeepInside::kLengths) TurnedRest(x, &gradient);
    for (const Spring& s : springs_) {
      const Point2 e = At(x, s.b) - At(x, s.a);
      const double length = e.norm(), k = Stiffness(s);
      if (!(length > 0)) continue;
      const Point2 d = e / length;
      // A stretched spring also resists being turned; one that is pressed does not count for that.
      const double across = std::max(0.0, 1 - s.length / length);
      Eigen::Matrix2d block = k * (d * d.transpose() * (1 - across) + across * Eigen::Matrix2d::Identity());
      const Point2 pull = k * (length - s.length) * d;
      for (int i : {0, 1}) {
        gradient[2 * s.a + i] -= pull[i];
        gradient[2 * s.b + i] += pull[i];
        for (int j : {0, 1}) {
          entries.emplace_back(2 * s.a + i, 2 * s.a + j, block(i, j));
          entries.emplace_back(2 * s.b + i, 2 * s.b + j, block(i, j));
          entries.emplace_back(2 * s.a + i, 2 * s.b + j, -block(i, j));
          entries.emplace_back(2 * s.b + i, 2 * s.a + j, -block(i, j));
        }
      }
    }
    matrix_.setFromTriplets(entries.begin(), entries.end());
    if (!analyzed_) solver_.analyzePattern(matrix_);
    analyzed_ = true;
    solver_.factorize(matrix_);
    if (solver_.info() != Eigen::Success) return false;
    const Eigen::VectorXd step = -solver_.solve(gradient);
    if (!step.allFinite()) return false;
    const double before = Energy(x);
    for (double t = 1; t > 1e-3; t /= 2) {
      const Eigen::VectorXd moved = x + t * step;
      if (Energy(moved) >= before) continue;
      x = moved;
      return true;
    }
    return false;
  }

 private:
  struct Spring {
    int a = 0, b = 0;
    double length = 0;
  };

  static Point2 At(const Eigen::VectorXd& x, int v) { return x.segment<2>(2 * v); }

  double Stiffness(const Spring& s) const {
    constexpr double kStiff = 1e3;
    return kStiff * size_ / s.length;
  }

  /// A triangle of the model laid flat.
  struct Rest {
    Point2 p[3];
    double area = 0;
  };

  static Rest RestOf(const ChartMesh& mesh, Eigen::Index t) {
    const auto corner = [&](int k) -> Eigen::Vector3d { return mesh.positions.row(mesh.triangles(t, k)); };
    const Eigen::Vector3d e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
    const double l1 = e1.norm(), longest = std::max({l1, e2.norm(), (e2 - e1).norm()});
    constexpr double kThinnest = 1e-3;  // thinner ones count as this thick: they have no angles to keep
    constexpr double kPoint = 1e-9;     // mm
    const double floor = std::max(kThinnest * longest, kPoint);
    const double height = l1 > 0 ? e1.cross(e2).norm() / l1 : 0;
    Rest rest;
    rest.p[0] = {0, 0};
    rest.p[1] = {std::max(l1, floor), 0};
    rest.p[2] = {l1 > 0 ? e1.dot(e2) / l1 : 0, std::max(height, floor)};
    rest.area = rest.p[1].x() * rest.p[2].y() / 2;
    return rest;
  }

  // The conformal error is the sum over the corners of w_k z_k in complex numbers, w_k the opposite edge.
  void AddConformalError(Eigen::Index t) {
    const Rest& rest = rest_[t];
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) {
        const Point2 wk = Edge(rest, k), wj = Edge(rest, j);
        const double re = wk.dot(wj) / (4 * rest.area),
                     im = (wk.x() * wj.y() - wk.y() * wj.x()) / (4 * rest.area);
        const int a = 2 * triangles_(t, k), b = 2 * triangles_(t, j);
        inside_.emplace_back(a, b, re);
        inside_.emplace_back(a + 1, b + 1, re);
        inside_.emplace_back(a, b + 1, -im);
        inside_.emplace_back(a + 1, b, im);
      }
  }

  // As rigid as possible: half the area times |J - R|^2, J the map's matrix and R the rotation next to it.
  void AddStiffness(Eigen::Index t) {
    const Rest& rest = rest_[t];
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) {
        const double weight = Edge(rest, k).dot(Edge(rest, j)) / (4 * rest.area);
        for (int i : {0, 1}) inside_.emplace_back(2 * triangles_(t, k) + i, 2 * triangles_(t, j) + i, weight);
      }
  }

  static Point2 Edge(const Rest& rest, int k) { return rest.p[(k + 2) % 3] - rest.p[(k + 1) % 3]; }

  // The part of that energy which is linear in x, and its gradient if wanted.
  double TurnedRest(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) const {
    double energy = 0;
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
      const Rest& rest = rest_[t];
      Eigen::Matrix2d j = Eigen::Matrix2d::Zero();  // times twice the area
      Point2 normal[3];
      for (int k = 0; k < 3; ++k) {
        const Point2 e = Edge(rest, k);
        normal[k] = {-e.y(), e.x()};
        j += At(x, triangles_(t, k)) * normal[k].transpose();
      }
      const double c = j(0, 0) + j(1, 1), s = j(1, 0) - j(0, 1), length = std::hypot(c, s);
      if (!(length > 0)) continue;
      energy += rest.area - length / 2;
      if (gradient == nullptr) continue;
      for (int k = 0; k < 3; ++k)
        gradient->segment<2>(2 * triangles_(t, k)) -=
            Point2(c * normal[k].x() - s * normal[k].y(), s * normal[k].x() + c * normal[k].y()) /
            (2 * length);
    }
    return energy;
  }

  int vertex_count_;
  KeepInside keep_;
  const Triangles& triangles_;
  std::vector<Rest> rest_;
  double size_ = 1;
  Triplets inside_;
  std::vector<Spring> springs_;
  Eigen::SparseMatrix<double> inside_matrix_, matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analyzed_ = false;
};

double FlatArea(const FlatChart& chart) {
  double area = 0;
  for (Eigen::Index t = 0; t < chart.mesh.triangles.rows(); ++t) {
    const auto corner = [&](int k) -> Point2 { return chart.uv.row(chart.mesh.triangles(t, k)).transpose(); };
    area += Orient(corner(0), corner(1), corner(2)) / 2;
  }
  return area;
}

}  // namespace

std::vector<int> CrossingEdges(const FlatChart& chart, const std::vector<int>& boundary) {
  std::vector<LineSegment> segments;
  for (int h : boundary)
    segments.push_back(
        {chart.uv.row(StartOf(chart, h)), chart.uv.row(EndOf(chart, h)), StartOf(chart, h), EndOf(chart, h)});
  std::vector<int> crossing;
  for (int k : CrossingSegments(segments)) crossing.push_back(boundary[k]);
  return crossing;
}

EqualSeams EqualizeSeams(const std::vector<int>& boundary, KeepInside keep, const std::function<void()>& poll,
                         FlatChart& chart) {
  BoundaryFit fit(chart, boundary, keep);
  const Points2 start = chart.uv;
  // About the chart's middle: the weight that holds it pulls to the origin.
  const Eigen::RowVector2d middle = start.colwise().mean();
  Eigen::VectorXd x(2 * start.rows());
  for (Eigen::Index v = 0; v < start.rows(); ++v) x.segment<2>(2 * v) = (start.row(v) - middle).transpose();
  constexpr int kMostSteps = 30;
  constexpr double kEqual = 1e-5;
  for (int step = 0; step < kMostSteps && fit.WorstError(x) > kEqual; ++step) {
    if (poll) poll();
    if (!fit.Step(x)) break;
  }
  EqualSeams result;
  result.uv.resize(start.rows(), 2);
  for (Eigen::Index v = 0; v < start.rows(); ++v) result.uv.row(v) = x.segment<2>(2 * v).transpose() + middle;
  constexpr double kLeastShare = 0.1;  // of the area: an outline may turn over without crossing itself
  const double least_area = kLeastShare * FlatArea(chart);
  for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
    chart.uv = (1 - share) * start + share * result.uv;
    result.whole = share == 1;
    if (FlatArea(chart) >= least_area && CrossingEdges(chart, boundary).empty()) break;
  }
  for (Eigen::Index v = 0; v < start.rows(); ++v) x.segment<2>(2 * v) = chart.uv.row(v).transpose();
  result.worst = fit.WorstError(x);
  return result;
}

}  // namespace dcharts
