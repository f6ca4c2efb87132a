// SPDX-License-Identifier: GPL-3.0-or-later
/// Solids as functions of space, negative inside, to build implicit shapes of.
#pragma once

#include <Eigen/Core>

namespace dcharts::shapes {

/// About the distance to an ellipsoid: exact on it, right in direction.
double Ellipsoid(const Eigen::Vector3d& p, const Eigen::Vector3d& centre, const Eigen::Vector3d& radii);

/// Distance to a rod from a to b with round ends of radii ra and rb.
double Limb(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b, double ra,
            double rb);

/// Distance to a flat cylinder around the z axis, its middle at height z, with edges of radius `rounding`.
double RoundDisk(const Eigen::Vector3d& p, double z, double radius, double half_height, double rounding);

}  // namespace dcharts::shapes
