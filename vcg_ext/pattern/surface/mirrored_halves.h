// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/surface_graph.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// The faces of a mesh whose second half is the exact mirror image of the first: that of face (a, b, c) is a
/// face (a, c, b). See SymmetricMesh.
struct MirroredHalves {
  int half = 0;  ///< faces in each; 0 when the mesh isn't symmetric

  bool IsSymmetric() const { return half > 0; }
  bool IsInFirst(int face) const { return face < half; }
  int ImageOf(int face) const { return face < half ? face + half : face - half; }
  int ImageOfEdge(int half_edge) const { return 3 * ImageOf(half_edge / 3) + 2 - half_edge % 3; }
  /// A face and its image meet there: both ends are on the mirror plane.
  bool IsOnPlane(const SurfaceGraph<SurfaceMesh>& surface, int half_edge) const {
    return surface.Opposite(half_edge) == ImageOfEdge(half_edge);
  }
};

}  // namespace dcharts
