// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <algorithm>

namespace dcharts {

/// A weighted sum of squared distances to planes and lines, as a function of the point (quadric error metric,
/// Garland and Heckbert 1997).
class Quadric {
 public:
  /// The plane through `point` with unit normal `n`.
  void AddPlane(const Eigen::Vector3d& n, const Eigen::Vector3d& point, double weight) {
    Add(weight * n * n.transpose(), point);
    weight_ += weight;
  }

  /// The line through `point` with unit direction `d`.
  void AddLine(const Eigen::Vector3d& d, const Eigen::Vector3d& point, double weight) {
    Add(weight * (Eigen::Matrix3d::Identity() - d * d.transpose()), point);
  }

  Quadric& operator+=(const Quadric& other) {
    a_ += other.a_;
    b_ += other.b_;
    c_ += other.c_;
    weight_ += other.weight_;
    return *this;
  }

  /// At least 0, also when rounding says otherwise.
  double At(const Eigen::Vector3d& p) const { return std::max(0.0, p.dot(a_ * p - 2 * b_) + c_); }

  double PlaneWeight() const { return weight_; }

 private:
  void Add(const Eigen::Matrix3d& a, const Eigen::Vector3d& point) {
    a_ += a;
    b_ += a * point;
    c_ += point.dot(a * point);
  }

  Eigen::Matrix3d a_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b_ = Eigen::Vector3d::Zero();
  double c_ = 0, weight_ = 0;
};

}  // namespace dcharts
