// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "surface/chart_patch.h"

namespace dcharts {

/// A cut in a part that is flat anyway (a flat ring cut to a disk) has both its sides on one line after
/// flattening. Moves them apart by a small part of the triangles' size, so that the slit is open to the eye
/// and to rounding. Changes `uv` only at such vertices; no triangle flips. `gap`: a distance (in units of
/// `uv`) below which the sides count as touching. `twin`: per local vertex the surface vertex it came from;
/// equal values are the two sides of one vertex.
void OpenSlits(const ChartPatch& patch, const std::vector<int>& twin, double gap, Points2& uv);

}  // namespace dcharts
