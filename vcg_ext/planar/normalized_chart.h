// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planar/chart_mesh.h"

namespace dcharts {

/// A chart moved to the origin, with a surface area of 1, and what it was in model units.
struct NormalizedChart {
  ChartMesh mesh;
  double extent = 0;  ///< half the longest side of the bounding box
  double scale = 0;   ///< sqrt(area); zero when no triangle has more area than rounding noise
};

/// `mesh` is in no use when the scale is zero.
NormalizedChart Normalized(const ChartMesh& chart);

}  // namespace dcharts
