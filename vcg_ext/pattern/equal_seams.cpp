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

/// The energy of one chart: half the squared conformal error over the area, and springs.
class BoundaryFit {
 public:
  BoundaryFit(const FlatChart& chart, const std::vector<int>& boundary)
      : vertex_count_(static_cast<int>(chart.uv.rows())) {
    double area = 0;
    for (Eigen::Index t = 0; t < chart.mesh.triangles.rows(); ++t) area += AddConformalError(chart, t);
    for (int h : boundary) {
      Spring spring;
      spring.a = StartOf(chart, h);
      spring.b = EndOf(chart, h);
      spring.length = (chart.mesh.positions.row(spring.a) - chart.mesh.positions.row(spring.b)).norm();
      if (spring.length > 0) springs_.push_back(spring);
    }
    size_ = std::sqrt(area);
    // A little weight on every vertex's place holds the chart where it is.
    for (int k = 0; k < 2 * vertex_count_; ++k) conformal_.emplace_back(k, k, 1e-9);
    matrix_.resize(2 * vertex_count_, 2 * vertex_count_);
    matrix_.setFromTriplets(conformal_.begin(), conformal_.end());
    conformal_matrix_ = matrix_;
  }

  double Energy(const Eigen::VectorXd& x) const {
    double energy = 0.5 * x.dot(conformal_matrix_ * x);
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
    Triplets entries = conformal_;
    Eigen::VectorXd gradient = conformal_matrix_ * x;
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

  // Adds the triangle's conformal error, a quadratic form; returns its area on the model.
  double AddConformalError(const FlatChart& chart, Eigen::Index t) {
    const auto corner = [&](int k) -> Eigen::Vector3d {
      return chart.mesh.positions.row(chart.mesh.triangles(t, k));
    };
    const Eigen::Vector3d e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
    const double l1 = e1.norm(), twice_area = e1.cross(e2).norm();
    const double longest = std::max({l1, e2.norm(), (e2 - e1).norm()});
    constexpr double kThinnest = 1e-3;  // thinner ones count as this thick: they have no angles to keep
    if (!(longest > 0)) return 0;
    const double height = l1 > 0 ? twice_area / l1 : 0;
    const double floor = kThinnest * longest;
    const Point2 p[3] = {
        {0, 0}, {std::max(l1, floor), 0}, {l1 > 0 ? e1.dot(e2) / l1 : 0, std::max(height, floor)}};
    const double rest = p[1].x() * p[2].y();
    // The error is sum over corners of w_k z_k in complex numbers, w_k the opposite edge.
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) {
        const Point2 wk = p[(k + 2) % 3] - p[(k + 1) % 3], wj = p[(j + 2) % 3] - p[(j + 1) % 3];
        const double re = wk.dot(wj) / (2 * rest), im = (wk.x() * wj.y() - wk.y() * wj.x()) / (2 * rest);
        const int a = 2 * chart.mesh.triangles(t, k), b = 2 * chart.mesh.triangles(t, j);
        conformal_.emplace_back(a, b, re);
        conformal_.emplace_back(a + 1, b + 1, re);
        conformal_.emplace_back(a, b + 1, -im);
        conformal_.emplace_back(a + 1, b, im);
      }
    return twice_area / 2;
  }

  int vertex_count_;
  double size_ = 1;
  Triplets conformal_;
  std::vector<Spring> springs_;
  Eigen::SparseMatrix<double> conformal_matrix_, matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analyzed_ = false;
};

}  // namespace

bool OutlineIsSimple(const FlatChart& chart, const std::vector<int>& boundary) {
  std::vector<LineSegment> segments;
  for (int h : boundary)
    segments.push_back(
        {chart.uv.row(StartOf(chart, h)), chart.uv.row(EndOf(chart, h)), StartOf(chart, h), EndOf(chart, h)});
  return !AnyCross(segments);
}

double EqualizeSeams(const std::vector<int>& boundary, const std::function<void()>& poll, FlatChart& chart) {
  BoundaryFit fit(chart, boundary);
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
  const Eigen::VectorXd end = x;
  const bool was_simple = OutlineIsSimple(chart, boundary);
  for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
    for (Eigen::Index v = 0; v < start.rows(); ++v)
      chart.uv.row(v) = (1 - share) * start.row(v) + share * (end.segment<2>(2 * v).transpose() + middle);
    if (!was_simple || OutlineIsSimple(chart, boundary)) break;
  }
  for (Eigen::Index v = 0; v < start.rows(); ++v) x.segment<2>(2 * v) = chart.uv.row(v).transpose();
  return fit.WorstError(x);
}

}  // namespace dcharts
