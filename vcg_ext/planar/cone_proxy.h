// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace dcharts {

/// Area-weighted sums of face normals. Additive: those of a union are the sums.
struct NormalMoments {
  double area = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< sum of A_t n_t
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< sum of A_t n_t n_t^T

  void Add(double face_area, const Eigen::Vector3d& normal);
  void Add(const NormalMoments& other);
};

/// The proxy <N_C, theta_C> of a union of conics with a common axis (Section 2.1.1).
struct ConeProxy {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< N_C, unit length
  double cos_angle = 1;                             ///< cos(theta_C), -1..1
};

/// F(C,t) of Eq. 1, 0..4: (N_C . n_t - cos theta_C)^2. A face without area (zero normal) fits everything: 0.
inline double FittingError(const ConeProxy& proxy, const Eigen::Vector3d& normal) {
  if (normal.isZero(0)) return 0;
  const double d = proxy.axis.dot(normal) - proxy.cos_angle;
  return d * d;
}

/// The proxy that minimizes the mean fitting error (Eq. 3), in closed form: for a given axis the best cosine
/// is the mean of N.n, so the axis is the eigenvector of the smallest eigenvalue of the centred covariance of
/// the normals. `mean_error`, if given, receives the minimum. With all normals equal the axis is that normal.
ConeProxy FitCone(const NormalMoments& moments, double* mean_error = nullptr);

/// min over axes of the mean fitting error with theta = pi/2 (the merge test of Section 3.3): 0 for a
/// cylinder.
double CylinderError(const NormalMoments& moments);

}  // namespace dcharts
