// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "pattern/flat_charts.h"

namespace dcharts {

/// Moves the vertices of a flat chart so that every boundary edge gets its length on the model: then both
/// sides of each seam are equally long. Angles change as little as can be: of all conformal maps this is the
/// one with scale 1 along the boundary (which has the least distortion of areas; Springborn, Schroeder,
/// Pinkall 2008). Gauss-Newton on the least-squares conformal energy with stiff springs along the boundary.
/// `boundary`: the half-edges of the boundary. Should the outline cross itself afterwards, it goes as far
/// that way as is free of that. Returns the largest relative error of a boundary edge's length that is left.
/// `poll` may throw.
double EqualizeSeams(const std::vector<int>& boundary, const std::function<void()>& poll, FlatChart& chart);

/// True when no two of the chart's boundary edges cross or touch, but for neighbours in their common corner.
bool OutlineIsSimple(const FlatChart& chart, const std::vector<int>& boundary);

}  // namespace dcharts
