// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "planar/chart_mesh.h"
#include "planar/coarse_chart.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"

namespace dcharts {

/// Whether a chart is so large that its map is better continued from that of a coarser chart: linear solves
/// take more than linear time.
bool IsLargeChart(const ChartMesh& chart);

/// A chart of a quarter as many triangles. `chart` must have an area of about 1 and outlive it.
CoarseChart CoarserChart(const ChartMesh& chart, const std::function<void()>& poll);

/// A map of the large chart with nearly the least stretch (Sander's energy), from `flatten` of its
/// CoarserChart, which may be large itself; `flatten` returns its UVs, or no rows when it can't be flattened.
/// `chart` must have an area of about 1. `known` is its CoarserChart, or null. Slivers among `shapes` are
/// relaxed. Nothing when `flatten` returns nothing or its map can't be continued.
std::optional<PlanePoints> MapFromCoarser(const ChartMesh& chart, const CoarseChart* known,
                                          const std::function<Points2(const ChartMesh&)>& flatten,
                                          const std::function<void()>& poll, RestShapes& shapes);

}  // namespace dcharts
