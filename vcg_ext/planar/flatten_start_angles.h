// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"
#include "planar/vertex_block_system.h"

namespace dcharts {

/// A nearly conformal map by linear solves only: `angle_steps` steps of angle-based flattening (ABF++:
/// Sheffer et al. 2005, in the reduced form on interior vertices), then the least-squares map that fits the
/// angles found (LSCM: Levy et al. 2002). May flip triangles; empty only when a solve fails.
std::optional<PlanePoints> StartFromAngles(const ChartMesh& chart, const RestShapes& shapes, int angle_steps,
                                           VertexBlockSystem& system);

}  // namespace dcharts
