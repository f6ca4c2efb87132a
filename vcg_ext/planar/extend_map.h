// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"

namespace dcharts {

/// Triangles at the edge of a flat map, some on it and some beside it.
struct MapEdge {
  ChartMesh mesh;            ///< consistently oriented triangles, in any number of pieces
  std::vector<bool> placed;  ///< per vertex: it is on the map, at `uv`
  std::vector<bool> fixed;   ///< per vertex: placed, and to stay there
  PlanePoints uv;            ///< per vertex, model units
};

/// Continues the map over the triangles beside it, each as rigid as possible (the local and global steps of
/// Liu et al. 2008, the global ones by a fixed number of relaxations), and says what that costs: an estimate
/// from above, as most of the map gives no way. Vertices that no triangle with a placed edge leads to stay
/// without a place. Sets `edge.uv` and `edge.placed`; returns the DirichletExcess() of every triangle,
/// infinity without a place.
std::vector<double> ExtendMap(MapEdge& edge);

/// Symmetric Dirichlet energy over 4, less 1, of the map from a triangle with edge vectors `e1`, `e2` in
/// space to one with edges `z1`, `z2` in the plane: >= 0; infinity when that is flipped, 0 for a triangle
/// without area in space.
double DirichletExcess(const Eigen::Vector3d& e1, const Eigen::Vector3d& e2, const Complex& z1,
                       const Complex& z2);

}  // namespace dcharts
