// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "planar/chart_mesh.h"

namespace dcharts {

/// A triangle on an integer grid, x0 y0 x1 y1 x2 y2, |coordinates| <= 2^30: all tests are exact.
using GridTriangle = std::array<std::int32_t, 6>;

/// Twice the signed area.
std::int64_t TwiceArea(const GridTriangle& triangle);

/// True when the interiors of two triangles meet; touching is no overlap. The orientation doesn't matter; a
/// triangle without area overlaps nothing.
bool Overlap(const GridTriangle& a, const GridTriangle& b);

/// All overlapping pairs (i < j), at most `limit` of them, in increasing order. `poll` is called now and then
/// and may throw.
std::vector<std::pair<int, int>> OverlappingPairs(const std::vector<GridTriangle>& triangles, size_t limit,
                                                  const std::function<void()>& poll = {});

/// A chart's triangles on a grid of 2^28 cells over the longer side of their box.
std::vector<GridTriangle> OnGrid(const Points2& uv, const Triangles& triangles);

/// The triangles of a chart that would overlap first: where no triangle is flipped and there is one boundary
/// loop, a map overlaps itself only where that crosses itself. All where there are several loops.
Triangles RimOf(const Triangles& triangles);

/// OverlappingPairs of a chart's map; most maps have none, which takes less to tell.
std::vector<std::pair<int, int>> OverlapsInMap(const Points2& uv, const Triangles& triangles, size_t limit,
                                               const std::function<void()>& poll = {});

/// Whether any two triangles of a chart's map overlap.
bool OverlapsItself(const Points2& uv, const Triangles& triangles, const std::function<void()>& poll = {});

}  // namespace dcharts
