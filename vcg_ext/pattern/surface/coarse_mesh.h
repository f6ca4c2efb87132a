// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/params.h"
#include "common/surface_data.h"
#include "surface/surface_mesh.h"
#include "surface/surface_graph.h"

namespace dcharts {

/// Charts for pieces of cloth or paper take no millions of triangles: the mesh with fewer, of the same shape
/// to within 0.4 % of its size and 0.3 % of its area, for fabric, which gives, to within twice that. Nothing
/// for a mesh that has few already, that needs its many, or that is not manifold. `surface`: made of `data`.
std::optional<SurfaceData> CoarseMesh(const SurfaceData& data, const SurfaceGraph<SurfaceMesh>& surface,
                                      PatternMaterial material);

}  // namespace dcharts
