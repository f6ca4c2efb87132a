// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planar/chart_mesh.h"
#include "surface/chart_patch.h"

namespace dcharts {

/// The map `uv` (#V by 2, model units) of the chart `from`, carried over to `to`, which has other cuts or
/// some other faces: a start for flattening it. Faces that `from` doesn't have are laid beside those that it
/// has. May flip triangles or overlap itself; has no rows when a vertex could not be placed. The faces of
/// both must ascend.
Points2 CarriedMap(const ChartPatch& from, const Points2& uv, const ChartPatch& to);

}  // namespace dcharts
