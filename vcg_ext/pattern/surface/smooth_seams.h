// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/surface_data.h"
#include "surface/charts.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// Seams run along the edges of triangles, in teeth where the triangles lie across them. Returns the mesh
/// with the vertices on seams moved along the surface until the seams are smooth; the ends of seams, borders
/// and corners of the model stay, seams along its sharp edges move a little only, and no triangle turns over.
/// `data`: the mesh `surface` was made of.
SurfaceData WithSmoothSeams(const SurfaceData& data, const SurfaceGraph<SurfaceMesh>& surface,
                            const SeamMask& seams);

}  // namespace dcharts
