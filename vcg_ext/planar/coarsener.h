// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "common/chart_ids.h"
#include "planar/edge_collapser.h"

namespace dcharts {

/// A surface as flat arrays, its vertices split into fans of faces.
struct FannedSurface {
  std::vector<Eigen::Vector3d> positions;  ///< per fan vertex
  std::vector<int> source_vertex;          ///< per fan vertex
  std::vector<int> vertex, opposite;       ///< per half-edge 3 f + i, the edge (i, i+1) of face f
};

/// What is left of a coarsened surface.
struct CoarsenedSurface {
  std::vector<int> source_face;       ///< per face that is left, ascending
  std::vector<int> vertex, opposite;  ///< per half-edge of these; vertices have the numbers that they had
  std::vector<int> heir;  ///< per face of the original surface, a face that is left: near it, of its chart
};

/// Collapses edges of a surface with charts, see CoarsenCharts: those that change the shape least first,
/// until at most `target_faces` faces are left or no edge may be collapsed. A large surface is coarsened in
/// blocks at first, on all threads, a large chart in halves; these hang on the surface alone. `history` may
/// be null, `poll` is called now and then and may throw.
CoarsenedSurface Coarsened(const FannedSurface& surface, const ChartIds& ids, int target_faces,
                           CollapseHistory* history, const std::function<void()>& poll);

}  // namespace dcharts
