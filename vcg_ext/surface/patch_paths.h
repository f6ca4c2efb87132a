// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "surface/chart_patch.h"

namespace dcharts {

/// Boundary loops of a patch, each as its half-edges in order, the first loop at the smallest half-edge.
std::vector<std::vector<int>> LoopsOf(const ChartPatch& patch);

/// 2 - 2 genus - loops.
int EulerCharacteristic(const ChartPatch& patch);

/// Shortest paths along the edges of a patch, from several sources at once.
class PatchPaths {
 public:
  explicit PatchPaths(const ChartPatch& patch);

  static constexpr double kFar = std::numeric_limits<double>::infinity();

  /// From `sources` (vertices) to all. With `inside_only`, boundary edges are no way and boundary vertices
  /// that are no source are ends, not ways through.
  void Run(const std::vector<int>& sources, bool inside_only);

  double Distance(int vertex) const { return distance_[vertex]; }
  int Source(int vertex) const { return source_[vertex]; }  ///< index into `sources`, -1 when not reached
  int From(int vertex) const {
    return from_[vertex];
  }  ///< a half-edge of the last edge of the path, -1 at a source
  bool OnBoundary(int vertex) const { return on_boundary_[vertex]; }
  std::vector<int> BoundaryVertices() const;
  /// The other end of the last edge.
  int Before(int vertex) const;
  /// The half-edges (one per edge) from `vertex` back to its source.
  std::vector<int> Path(int vertex) const;

 private:
  const ChartPatch& patch_;
  std::vector<int> ring_start_,
      ring_;  // per vertex the half-edges at it: those that start there, and incoming border ones
  std::vector<char> on_boundary_;
  std::vector<double> distance_;
  std::vector<int> source_, from_;
};

}  // namespace dcharts
