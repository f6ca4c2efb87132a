// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "implicit_mesh.h"
#include "implicit_solids.h"
#include "mesh_builder.h"
#include "shapes.h"

namespace dcharts::shapes {
namespace {

using Eigen::Vector3d;

/// A chess bishop that stands on z = 0: a turned body, and the slit in its head, slanting down from +x.
/// Mirrored in y = 0.
double Chessman(const Vector3d& p) {
  double d = RoundDisk(p, 0.12, 0.46, 0.12, 0.06);                            // foot
  d = SmoothUnion(d, RoundDisk(p, 0.32, 0.34, 0.09, 0.07), 0.06);             // ring on it
  d = SmoothUnion(d, Limb(p, {0, 0, 0.35}, {0, 0, 1.15}, 0.26, 0.13), 0.10);  // stem
  d = SmoothUnion(d, RoundDisk(p, 1.17, 0.27, 0.06, 0.05), 0.06);             // collar
  d = SmoothUnion(d, Ellipsoid(p, {0, 0, 1.50}, {0.25, 0.25, 0.34}), 0.05);   // head
  d = SmoothUnion(d, Ellipsoid(p, {0, 0, 1.87}, {0.10, 0.10, 0.10}), 0.06);   // ball on top
  constexpr double kHalfWidth = 0.055, kBottom = -0.02;                       // of the slit
  const Vector3d inwards = Vector3d(-1, 0, -1.3).normalized(), across(-inwards.z(), 0, inwards.x());
  const Vector3d q = p - Vector3d(0.02, 0, 1.52);
  const double slit = std::max(std::abs(q.dot(across)) - kHalfWidth, q.dot(inwards) - kBottom);
  return -SmoothUnion(-d, slit, 0.03);
}

}  // namespace

SurfaceData Bishop(int n) {
  RequireAtLeast("The number of cells", n, 48);
  return PolygonizeImplicit(Chessman, Vector3d(-0.56, -0.56, -0.1), Vector3d(0.56, 0.56, 2.07), 2.0 / n);
}

}  // namespace dcharts::shapes
