// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "planar/coarsener.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/surface_graph.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// A surface with charts and fewer faces. Its faces keep their order, its vertices are some of the original
/// ones, in their places; one that isn't manifold stands there once per fan of faces.
struct CoarseSurface {
  std::unique_ptr<SurfaceMesh> mesh;  ///< with face-face topology, ready for SurfaceGraph
  ChartIds ids;                       ///< per coarse face
  std::vector<int> source_face;       ///< per coarse face, ascending, its index in the original surface
  std::vector<int> heir;           ///< per face of the original surface, a coarse face near it, of its chart
  std::vector<int> source_vertex;  ///< per coarse vertex, its index in the original surface
};

/// See CoarsenCharts.
CoarseSurface CoarsenFanned(const FannedSurface& surface, const ChartIds& ids, int target_faces,
                            const std::function<void()>& poll);

/// Collapses edges, those that change the shape least first (quadric error [Garland and Heckbert 1997]),
/// until at most `target_faces` faces are left or no edge may be collapsed; at once with all faces when there
/// are no more than that. A large surface goes in blocks or halves first, see Coarsened. Meant for
/// trials: what a chart's flattening costs is nearly the same on the coarse surface.
///
/// Charts keep their topology and their neighbours. Where three or more charts or borders meet, and where the
/// mesh isn't manifold, vertices stay; borders are only shortened along themselves, to no less than two edges
/// (three around a loop), and a chart to no less than 30 faces. Small charts get more faces for their area.
/// Any `ids` are taken, unassigned faces as one more chart. Deterministic.
/// `poll` is called now and then and may throw.
template <class MeshType>
CoarseSurface CoarsenCharts(const SurfaceGraph<MeshType>& surface, const ChartIds& ids, int target_faces,
                            const std::function<void()>& poll = {}) {
  CutVertices fans = GlueCorners(surface.HalfEdgeCount(), [&](int h) { return surface.Opposite(h); });
  FannedSurface fanned;
  fanned.positions.resize(fans.count);
  fanned.source_vertex.resize(fans.count);
  fanned.opposite.resize(surface.HalfEdgeCount());
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int v = fans.of_corner[h];
    fanned.source_vertex[v] = surface.Vertex(h);
    fanned.positions[v] = surface.Position(surface.Vertex(h));
    fanned.opposite[h] = surface.Opposite(h);
  }
  fanned.vertex = std::move(fans.of_corner);
  return CoarsenFanned(fanned, ids, target_faces, poll);
}

}  // namespace dcharts
