// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <Eigen/Geometry>

#include "implicit_mesh.h"
#include "implicit_solids.h"
#include "mesh_builder.h"
#include "shapes.h"

namespace dcharts::shapes {
namespace {

using Eigen::Vector3d;

/// A sitting teddy bear that looks along +y, its head up along +z, mirrored in x = 0.
double Teddy(const Vector3d& at) {
  const Vector3d p(std::abs(at.x()), at.y(), at.z());
  double d = Ellipsoid(p, {0, -0.02, 0.62}, {0.44, 0.38, 0.52});                          // body
  d = SmoothUnion(d, Ellipsoid(p, {0, 0.04, 1.42}, {0.43, 0.37, 0.39}), 0.16);            // head
  d = SmoothUnion(d, Ellipsoid(p, {0, 0.38, 1.31}, {0.19, 0.17, 0.14}), 0.10);            // muzzle
  d = SmoothUnion(d, Ellipsoid(p, {0.33, 0.0, 1.79}, {0.17, 0.10, 0.18}), 0.07);          // ears
  d = SmoothUnion(d, Limb(p, {0.36, 0.04, 0.93}, {0.72, 0.26, 0.66}, 0.14, 0.16), 0.10);  // arms
  d = SmoothUnion(d, Limb(p, {0.24, 0.12, 0.28}, {0.46, 0.58, 0.20}, 0.20, 0.17), 0.10);  // legs
  d = SmoothUnion(d, Ellipsoid(p, {0.47, 0.68, 0.26}, {0.18, 0.11, 0.25}), 0.08);         // feet
  return SmoothUnion(d, Ellipsoid(p, {0, -0.42, 0.3}, {0.12, 0.12, 0.12}), 0.08);         // tail
}

}  // namespace

SurfaceData Plush(int n) {
  RequireAtLeast("The number of cells", n, 32);
  return PolygonizeImplicit(Teddy, Vector3d(-1.06, -0.7, -0.12), Vector3d(1.06, 0.95, 2.12), 2.0 / n);
}

}  // namespace dcharts::shapes
