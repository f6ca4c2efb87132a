// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pattern/flat_charts.h"

namespace dcharts {

/// One side of a fine seam.
struct FineSide {
  int chart = 0;
  std::vector<int> vertices;  ///< of the chart, in the seam's direction: one more than edges
  bool backwards = false;     ///< the chart's boundary runs against the seam's direction
};

/// A run of boundary edges that all its sides have in common, as fine as the model.
struct FineSeam {
  std::vector<double> arc;  ///< 3D arc length at each vertex, mm, from 0
  std::vector<FineSide> sides;
  bool closed = false;  ///< the last vertex is the first again

  int VertexCount() const { return static_cast<int>(arc.size()); }
  double Length() const { return arc.back(); }
};

/// Where a chart's boundary half-edge lies: edge k, from vertex k to k + 1, of one side of a seam.
struct SeamPlace {
  int seam = -1, side = 0, edge = 0;
};

struct SeamGraph {
  std::vector<FineSeam> seams;
  std::vector<std::vector<SeamPlace>> places;  ///< per chart, per half-edge; seam -1 inside the chart
};

/// Chains the boundary edges of charts to seams. A seam ends where its sides part: where three pieces meet,
/// at a dart's tip, and where the model's border begins.
SeamGraph SeamsOf(const FlatCharts& charts);

/// The boundary of a chart: per vertex the half-edges that leave it and arrive there along the boundary, -1
/// inside.
struct ChartBoundary {
  std::vector<int> leaving, arriving;
};
ChartBoundary BoundaryOf(const FlatChart& chart, const std::vector<char>& is_boundary);

}  // namespace dcharts
