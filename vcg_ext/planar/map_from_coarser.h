// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "planar/chart_mesh.h"
#include "planar/coarser_charts.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"

namespace dcharts {

/// A map of a large chart, normalized, with nearly the least stretch (Sander's energy), from `flatten` of a
/// coarser one, which may be large itself; `flatten` returns its UVs, or no rows when it can't be flattened.
/// Slivers among `shapes` are relaxed. Nothing when `flatten` returns nothing or its map can't be continued.
std::optional<PlanePoints> MapFromCoarser(const ChartMesh& normalized, CoarserCharts& coarser,
                                          const std::function<Points2(const ChartMesh&)>& flatten,
                                          const std::function<void()>& poll, RestShapes& shapes);

}  // namespace dcharts
