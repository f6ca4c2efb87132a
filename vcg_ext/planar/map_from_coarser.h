// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "planar/chart_mesh.h"
#include "planar/coarser_charts.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"

namespace dcharts {

/// UVs of a chart, or no rows when it can't be flattened; the coarser charts are those of a large chart, else
/// null.
using FlattenCoarser = std::function<Points2(const ChartMesh& chart, CoarserCharts* coarser)>;

/// A map of a large chart with nearly the least stretch (Sander's energy), from `flatten` of a coarser one,
/// which may be large itself. `known`: the coarser charts of this one, where there are some, or null. Slivers
/// among `shapes` are relaxed. Nothing when `flatten` returns nothing or its map can't be continued.
std::optional<PlanePoints> MapFromCoarser(const NormalizedChart& chart, CoarserCharts* known,
                                          const FlattenCoarser& flatten, const std::function<void()>& poll,
                                          RestShapes& shapes);

}  // namespace dcharts
