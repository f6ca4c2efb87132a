// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/surface_data.h"
#include "pattern/surface/symmetry.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// One half of a mesh and its exact mirror image, joined along the plane.
struct SymmetricMesh {
  SurfaceData mesh;              ///< vertices and faces only
  int half = 0;                  ///< face f < half has the image f + half
  std::vector<int> source_face;  ///< per face the one of the given mesh at its place
};

/// The half of `data` that the plane's normal points to, and its image. Faces that cross the plane are cut
/// there; vertices next to it are moved onto it. `surface`, `source_face`: made of `data`; the plane is in
/// its coordinates.
SymmetricMesh MakeSymmetricMesh(const SurfaceData& data, const SurfaceGraph<SurfaceMesh>& surface,
                                const std::vector<int>& source_face, const MirrorPlane& mirror);

/// The plane of a symmetric mesh, with exact images. `surface` was made of it.
MirrorPlane ExactMirrorPlane(const SymmetricMesh& symmetric, const SurfaceGraph<SurfaceMesh>& surface);

}  // namespace dcharts
