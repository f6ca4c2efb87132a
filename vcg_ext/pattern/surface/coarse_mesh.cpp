// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/coarse_mesh.h"

#include <algorithm>
#include <set>
#include <utility>

#include "pattern/surface/data_coordinates.h"
#include "pattern/surface/same_shape.h"
#include "surface/charts.h"
#include "surface/coarsen.h"

namespace dcharts {
namespace {

// Over an edge with several faces, or whose faces disagree in orientation, the two sides would not keep the
// same vertices.
bool IsManifold(const SurfaceGraph<SurfaceMesh>& surface) {
  std::set<std::pair<int, int>> borders;
  for (int h = 0; h < surface.HalfEdgeCount(); ++h)
    if (surface.Opposite(h) < 0) {
      const int v = surface.Vertex(h), w = surface.Vertex(Next(h));
      if (!borders.insert({std::min(v, w), std::max(v, w)}).second) return false;
    }
  return true;
}

}  // namespace

std::optional<SurfaceData> CoarseMesh(const SurfaceData& data, const SurfaceGraph<SurfaceMesh>& surface,
                                      PatternMaterial material) {
  constexpr int kEnough = 12000;  // faces
  constexpr double kMore = 1.5, kOfSize = 4e-3, kArea = 3e-3;
  const double gives = material == PatternMaterial::kFabric ? 2 : 1;
  if (surface.FaceCount() < kMore * kEnough || !IsManifold(surface)) return std::nullopt;
  const double distance = gives * kOfSize * LongestSide(data);
  const ChartIds one_chart(surface.FaceCount(), 0);
  for (double faces = kEnough; kMore * faces <= surface.FaceCount(); faces *= kMore) {
    const CoarseSurface coarse = CoarsenCharts(surface, one_chart, static_cast<int>(faces));
    SurfaceData mesh;
    for (int v : coarse.source_vertex) mesh.vertices.push_back(data.vertices[v]);
    for (const auto& face : coarse.mesh->face) {
      mesh.faces.emplace_back();
      for (int k = 0; k < 3; ++k)
        mesh.faces.back()[k] = static_cast<int>(vcg::tri::Index(*coarse.mesh, face.cV(k)));
    }
    if (AreSameShape(data, mesh, {distance, gives * kArea})) return mesh;
  }
  return std::nullopt;
}

}  // namespace dcharts
