// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "pattern/flat_charts.h"

namespace dcharts {

/// What the inside of a chart keeps as far as it can.
enum class KeepInside {
  kAngles,  ///< fabric: a conformal map
  kLengths  ///< paper: as rigid as possible
};

struct EqualSeams {
  double worst = 0;   ///< largest relative error of a boundary edge's length in `chart`
  bool whole = true;  ///< false: the outline would cross itself or turn over, so it went only part of the way
  Points2 uv;         ///< where the vertices would be then
};

/// Moves the vertices of a flat chart so that every boundary edge gets its length on the model: then both
/// sides of each seam are equally long. With kAngles it becomes, of all conformal maps, the one with scale 1
/// along the boundary (which has the least distortion of areas; Springborn, Schroeder, Pinkall 2008).
/// Gauss-Newton on the energy of the inside with stiff springs along the boundary. `boundary`: the half-edges
/// of the boundary. Should the outline cross itself or turn over, it goes as far that way as is free of that.
/// `poll` may throw.
EqualSeams EqualizeSeams(const std::vector<int>& boundary, KeepInside keep, const std::function<void()>& poll,
                         FlatChart& chart);

/// The boundary half-edges that cross or touch another, but for neighbours in their common corner; sorted.
std::vector<int> CrossingEdges(const FlatChart& chart, const std::vector<int>& boundary);

}  // namespace dcharts
