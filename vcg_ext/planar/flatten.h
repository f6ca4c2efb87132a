// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <string>

#include "common/params.h"
#include "planar/chart_mesh.h"

namespace dcharts {

class CoarserCharts;

struct FlattenOptions {
  FlattenMethod method = FlattenMethod::kStretchMinimizing;
  bool linf_finish = true;  ///< lower the worst stretch after the mean stretch; not of conformal maps
  /// Lowering the worst stretch doesn't lift the L2 stretch of a chart that is within this above it; >= 1.
  double l2_bound = std::numeric_limits<double>::infinity();
  /// UVs to start from, as those of TrialOptions; may be null.
  const Points2* start = nullptr;
  /// Of a large chart, where there are some; may be null.
  CoarserCharts* coarser = nullptr;
};

struct Flattening {
  bool ok = false;   ///< false: no flip-free map was found, the chart needs a cut; `why` says so
  std::string why;   ///< empty when ok
  std::string note;  ///< why `uv` isn't the conformal map asked for; else empty. Goes on after "chart 3: "
  Points2 uv;        ///< #V by 2, model units, empty unless ok; finite, every triangle with positive area,
                     ///< in float32 as well where the chart's extent allows that; UV area = surface
                     ///< area (a chart without area gets a tiny layout with stretch 1)
  double l2_stretch = 0;    ///< of this chart at its own scale, >= 1
  double linf_stretch = 0;  ///< largest singular value of UV -> surface, at the chart's own scale
};

/// Free-boundary flattening without flipped triangles: stretch-minimizing [SGSH02] or conformal [SLMB05]. A
/// chart without a usable conformal map is flattened with the least stretch. The boundary may still cross
/// itself (global overlap): see overlap.h. `poll` is called now and then and may throw to stop the work. The
/// result depends on nothing but its arguments.
Flattening Flatten(const ChartMesh& chart, const FlattenOptions& options = {},
                   const std::function<void()>& poll = {});

}  // namespace dcharts
