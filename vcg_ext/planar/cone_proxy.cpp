// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/cone_proxy.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace dcharts {

void NormalMoments::Add(double face_area, const Eigen::Vector3d& normal) {
  area += face_area;
  first += face_area * normal;
  second += face_area * normal * normal.transpose();
}

void NormalMoments::Add(const NormalMoments& other) {
  area += other.area;
  first += other.first;
  second += other.second;
}

ConeProxy FitCone(const NormalMoments& moments, double* mean_error) {
  ConeProxy proxy;
  if (mean_error) *mean_error = 0;
  if (!(moments.area > 0)) return proxy;
  const Eigen::Vector3d mean = moments.first / moments.area;
  const Eigen::Matrix3d covariance = moments.second / moments.area - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.compute(covariance);
  // Every axis fits a plane (all eigenvalues are 0): take the normal, which is stable and has the right
  // angle.
  constexpr double kFlat = 1e-9;
  if (eigen.eigenvalues()[1] < kFlat && mean.norm() > 0.5) {
    proxy.axis = mean.normalized();
    proxy.cos_angle = std::min(1.0, mean.norm());
    return proxy;
  }
  proxy.axis = eigen.eigenvectors().col(0).normalized();
  proxy.cos_angle = std::clamp(proxy.axis.dot(mean), -1.0, 1.0);
  if (mean_error) *mean_error = std::max(0.0, proxy.axis.dot(covariance * proxy.axis));
  return proxy;
}

double CylinderError(const NormalMoments& moments) {
  if (!(moments.area > 0)) return 0;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(moments.second / moments.area, Eigen::EigenvaluesOnly);
  return std::max(0.0, eigen.eigenvalues()[0]);
}

}  // namespace dcharts
