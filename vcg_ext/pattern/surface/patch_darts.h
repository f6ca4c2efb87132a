// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "surface/chart_patch.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// A cut that ends inside the chart: local half-edges from its tip on, on both of its sides.
struct PatchDart {
  std::vector<int> arriving, leaving;
};

/// The darts of a chart. A slit that touches no border is two of them.
std::vector<PatchDart> DartsOf(const SurfaceGraph<SurfaceMesh>& surface, const ChartPatch& patch);

}  // namespace dcharts
