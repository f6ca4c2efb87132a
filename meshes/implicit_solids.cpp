// SPDX-License-Identifier: GPL-3.0-or-later
#include "implicit_solids.h"

#include <algorithm>
#include <cmath>

namespace dcharts::shapes {

using Eigen::Vector3d;

double Ellipsoid(const Vector3d& p, const Vector3d& centre, const Vector3d& radii) {
  const Vector3d q = (p - centre).cwiseQuotient(radii);
  const double slope = q.cwiseQuotient(radii).norm();
  return slope > 0 ? q.norm() * (q.norm() - 1) / slope : -radii.minCoeff();
}

double Limb(const Vector3d& p, const Vector3d& a, const Vector3d& b, double ra, double rb) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - (ra + t * (rb - ra));
}

double RoundDisk(const Vector3d& p, double z, double radius, double half_height, double rounding) {
  const double across = std::hypot(p.x(), p.y()) - (radius - rounding),
               along = std::abs(p.z() - z) - (half_height - rounding);
  return std::min(std::max(across, along), 0.0) + std::hypot(std::max(across, 0.0), std::max(along, 0.0)) -
         rounding;
}

}  // namespace dcharts::shapes
