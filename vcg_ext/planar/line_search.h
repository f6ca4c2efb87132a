// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"
#include "planar/stretch_energy.h"

namespace dcharts {

/// Energy of the whole map; +infinity when a triangle has no positive area.
double MapEnergy(const StretchEnergy& energy, const Triangles& triangles, const RestShapes& shapes,
                 const PlanePoints& uv);

/// The smallest t > 0 at which a triangle loses its area on the way from `uv` to uv + t direction
/// [Smith and Schaefer 2015]; +infinity when none does before `up_to`. All areas in `uv`
/// must be positive.
double FirstFlip(const Triangles& triangles, const PlanePoints& uv, const PlanePoints& direction,
                 double up_to = std::numeric_limits<double>::infinity());

/// Moves `uv` along `direction`, at most `longest_step` and 0.9 of the way to the first flip, halved until
/// the energy falls enough (Armijo), and further down to 1 while that lowers it more. `value_of` is the
/// energy of a map, `slope` its derivative along the direction (< 0), `value` that of `uv`, replaced by the
/// new one. False, and nothing moved, when it falls nowhere.
bool SearchLine(const std::function<double(const PlanePoints&)>& value_of, const Triangles& triangles,
                const PlanePoints& direction, double slope, double longest_step, PlanePoints& uv,
                double& value);

}  // namespace dcharts
