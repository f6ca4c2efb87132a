// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"

namespace dcharts {

/// Tutte's embedding with uniform weights: the longest boundary loop on a circle by arc length, every other
/// loop filled by a fan around one helper vertex. Without flips in exact arithmetic; triangles deep inside
/// may round to no area. Empty only when the solve fails.
std::optional<PlanePoints> StartFromTutte(const ChartMesh& chart);

}  // namespace dcharts
