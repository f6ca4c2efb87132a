// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "surface/surface_graph.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// A plane that mirrors a surface onto itself, nearly.
struct MirrorPlane {
  Eigen::Vector3d normal{1, 0, 0};  ///< unit vector
  double offset = 0;                ///< of the plane along the normal

  double Height(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
  Eigen::Vector3d Mirrored(const Eigen::Vector3d& p) const { return p - 2 * Height(p) * normal; }
};

/// The plane that mirrors the surface best, when it does so but for noise: nearly all of its area has a
/// mirror image within a fraction of an edge's length. The triangles need not be symmetric.
std::optional<MirrorPlane> FindMirrorPlane(const SurfaceGraph<SurfaceMesh>& surface);

}  // namespace dcharts
