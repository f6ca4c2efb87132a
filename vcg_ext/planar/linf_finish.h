// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"
#include "planar/vertex_block_system.h"

namespace dcharts {

/// Lowers the worst stretch (Linf) of a map with about the least mean stretch (L2), for a bounded rise of
/// L2 - 1: by a twentieth at most when the worst stretch is small anyway, up to a fifth while it is large,
/// and not above `l2_bound` unless it is there already. `chart` must be normalized, all areas in `uv`
/// positive; they are afterwards. Slivers in `shapes` are relaxed.
void LowerWorstStretch(const ChartMesh& chart, double l2_bound, RestShapes& shapes, VertexBlockSystem& system,
                       const std::function<void()>& poll, PlanePoints& uv);

}  // namespace dcharts
