// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/patch_darts.h"

#include <utility>

namespace dcharts {

std::vector<PatchDart> DartsOf(const SurfaceGraph<SurfaceMesh>& surface, const ChartPatch& patch) {
  std::vector<int> leaving(patch.VertexCount(), -1), arriving(patch.VertexCount(), -1);
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    if (patch.opposite[h] >= 0) continue;
    leaving[patch.Vertex(h)] = h;
    arriving[patch.Vertex(Next(h))] = h;
  }
  std::vector<PatchDart> darts;
  for (int tip = 0; tip < patch.VertexCount(); ++tip) {
    PatchDart dart;
    for (int left = tip, right = tip;;) {
      const int in = arriving[left], out = leaving[right];
      if (in < 0 || out < 0 || surface.Opposite(patch.SurfaceHalfEdge(in)) != patch.SurfaceHalfEdge(out))
        break;
      dart.arriving.push_back(in);
      dart.leaving.push_back(out);
      left = patch.Vertex(in);
      right = patch.Vertex(Next(out));
      if (left == right) break;  // the other end of a slit
    }
    if (!dart.arriving.empty()) darts.push_back(std::move(dart));
  }
  return darts;
}

}  // namespace dcharts
