// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "planar/chart_mesh.h"
#include "planar/coarser_charts.h"

namespace dcharts {

/// A map to measure with is left as it is when its parts are apart, crumpled where they were drawn; for an
/// atlas the worst of that is spread out.
enum class ApartMapFor { kMeasuring, kAtlas };

struct ApartMap {
  Points2 uv;  ///< #V by 2, model units, UV area = surface area
  double l2_stretch = 0, linf_stretch = 0;
};

/// Where a map without flipped triangles laps over itself a little, its parts are drawn apart, and the chart
/// gives way with the least stretch. `uv`: that map, in any scale; not used of a large chart (IsLargeChart),
/// whose map is continued from that of a coarser one; `coarser` are its coarser charts, where there are some,
/// or null. Nothing when they don't come apart in a few rounds or when the L2 stretch would be above
/// `l2_bound`. `poll` is called now and then and may throw.
std::optional<ApartMap> LayApart(const ChartMesh& chart, const Points2& uv, double l2_bound, ApartMapFor use,
                                 const std::function<void()>& poll, CoarserCharts* coarser = nullptr);

}  // namespace dcharts
