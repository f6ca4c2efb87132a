// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/chart_patch.h"

namespace dcharts {

ChartPatch CutOpen(const ChartPatch& patch, const std::vector<int>& edges) {
  ChartPatch open = patch;
  for (int h : edges)
    for (int k : {h, patch.opposite[h]})
      if (k >= 0) open.opposite[k] = -1;
  const CutVertices cut = GlueCorners(open.HalfEdgeCount(), [&](int h) { return open.opposite[h]; });
  // Not by resize: Eigen frees what is there before it asks for memory, and again when there is none.
  Points3 positions(cut.count, 3);
  for (int h = 0; h < open.HalfEdgeCount(); ++h) {
    open.mesh.triangles(h / 3, h % 3) = cut.of_corner[h];
    positions.row(cut.of_corner[h]) = patch.mesh.positions.row(patch.Vertex(h));
  }
  open.mesh.positions.swap(positions);
  return open;
}

}  // namespace dcharts
