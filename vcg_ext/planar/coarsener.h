// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "common/chart_ids.h"
#include "planar/collapsing_mesh.h"

namespace dcharts {

/// A surface as flat arrays, its vertices split into fans of faces.
struct FannedSurface {
  std::vector<Eigen::Vector3d> positions;  ///< per fan vertex
  std::vector<int> source_vertex;          ///< per fan vertex
  std::vector<int> vertex, opposite;       ///< per half-edge 3 f + i, the edge (i, i+1) of face f
};

/// The collapses that made a coarse surface, in their order. At each the vertex had the corners of `ring`
/// around it, counterclockwise; those of a vertex at the border run from border to border.
struct CollapseHistory {
  struct Step {
    int vertex;
    int ring_begin;  ///< in `rings`; the ring ends where that of the next step begins
    bool closed;
  };
  std::vector<Step> steps;
  std::vector<int> rings;
};

/// What is left of a coarsened surface.
struct CoarsenedSurface {
  CollapsingMesh mesh;
  std::vector<int> heir;  ///< per face of the original surface, a face that is left: near it, of its chart
};

/// Collapses edges of a surface with charts, see CoarsenCharts: those that change the shape least first,
/// until at most `target_faces` faces are left or no edge may be collapsed. `history` may be null,
/// `poll` is called now and then and may throw.
CoarsenedSurface Coarsened(const FannedSurface& surface, const ChartIds& ids, int target_faces,
                           CollapseHistory* history, const std::function<void()>& poll);

}  // namespace dcharts
