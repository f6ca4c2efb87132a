// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "pattern/pattern.h"
#include "planar/chart_mesh.h"

namespace dcharts {

/// One chart of the finished object, laid flat.
struct FlatChart {
  ChartMesh mesh;                 ///< positions on the finished object, mm
  Points2 uv;                     ///< #V by 2, mm
  std::vector<int> model_vertex;  ///< per vertex: the one of the model it is a copy of
  std::vector<int> source_face;   ///< per triangle: its face in the SurfaceData
};

/// One side of a boundary edge: edge (i, i+1) of triangle f of a chart, as half-edge 3 f + i.
struct ChartEdge {
  int chart = 0, half_edge = 0;
};

/// All charts of a model, and which boundary edges belong together.
struct FlatCharts {
  std::vector<FlatChart> charts;
  /// Each boundary edge of a chart is in one of these: with the one opposite, alone at the model's border, or
  /// with all others between the same vertices where more faces meet or faces disagree in orientation.
  std::vector<std::vector<ChartEdge>> edges;
};

/// A half-edge's start and end in its chart.
inline int StartOf(const FlatChart& chart, int half_edge) {
  return chart.mesh.triangles(half_edge / 3, half_edge % 3);
}
inline int EndOf(const FlatChart& chart, int half_edge) {
  return chart.mesh.triangles(half_edge / 3, (half_edge + 1) % 3);
}

}  // namespace dcharts
