// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "common/surface_data.h"

namespace dcharts::shapes {

/// A function of space, negative inside, about a distance near its zero set.
using ImplicitFunction = std::function<double(const Eigen::Vector3d&)>;

/// Triangles on the zero set of `function`, by surface nets over a grid of `cell`-sized cubes in the box from
/// `low` to `high`, which the shape must not touch, then evened out on the surface: vertices within about
/// 1e-9 of the zero set, nearly equilateral triangles. Features thinner than two cells are lost or become
/// non-manifold.
SurfaceData PolygonizeImplicit(const ImplicitFunction& function, const Eigen::Vector3d& low,
                               const Eigen::Vector3d& high, double cell);

/// The least of two distances, rounded where they differ by less than `radius`.
double SmoothUnion(double a, double b, double radius);

}  // namespace dcharts::shapes
