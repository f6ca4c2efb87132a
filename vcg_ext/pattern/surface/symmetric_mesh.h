// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/surface_data.h"
#include "pattern/surface/mirror_plane.h"
#include "pattern/surface/mirrored_halves.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// One half of a mesh and its exact mirror image, joined along the plane.
struct SymmetricMesh {
  SurfaceData mesh;  ///< vertices and faces only
  MirroredHalves halves;
};

/// The half of `data` that the plane's normal points to, and its image. Faces that cross the plane are cut
/// there; vertices next to it are moved onto it. `surface`: made of `data`; the plane is in its coordinates.
SymmetricMesh MakeSymmetricMesh(const SurfaceData& data, const SurfaceGraph<SurfaceMesh>& surface,
                                const MirrorPlane& mirror);

/// `mesh` is the symmetric one, some vertices of which were moved: what they are in its first half is
/// mirrored to the other. `symmetric`: as it was.
void MirrorFirstHalf(const SurfaceData& symmetric, const MirroredHalves& halves, SurfaceData& mesh);

}  // namespace dcharts
