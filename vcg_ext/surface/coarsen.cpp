// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/coarsen.h"

#include <vcg/complex/allocate.h>

#include <algorithm>
#include <utility>

namespace dcharts {

CoarseSurface CoarsenFanned(const FannedSurface& surface, const ChartIds& ids, int target_faces,
                            const std::function<void()>& poll) {
  CoarsenedSurface left = Coarsened(surface, ids, target_faces, nullptr, poll);
  CoarseSurface coarse;
  coarse.mesh = std::make_unique<SurfaceMesh>();
  SurfaceMesh& mesh = *coarse.mesh;
  const int fan_count = static_cast<int>(surface.positions.size());
  std::vector<int> new_vertex(fan_count, -1);
  std::vector<int> order;
  for (int v : left.vertex) new_vertex[v] = 0;
  for (int v = 0; v < fan_count; ++v)
    if (new_vertex[v] == 0) order.push_back(v);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return surface.source_vertex[a] < surface.source_vertex[b]; });
  vcg::tri::Allocator<SurfaceMesh>::AddVertices(mesh, order.size());
  for (int v : order) {
    const int n = new_vertex[v] = static_cast<int>(coarse.source_vertex.size());
    coarse.source_vertex.push_back(surface.source_vertex[v]);
    const Eigen::Vector3d& p = surface.positions[v];
    mesh.vert[n].P() = vcg::Point3d(p[0], p[1], p[2]);
  }
  for (int f : left.source_face) coarse.ids.push_back(ids[f]);
  coarse.source_face = std::move(left.source_face);
  coarse.heir = std::move(left.heir);
  vcg::tri::Allocator<SurfaceMesh>::AddFaces(mesh, coarse.ids.size());
  // The topology is known here. Found again from the vertices it might close slits.
  for (int h = 0; h < static_cast<int>(left.vertex.size()); ++h) {
    SurfaceFace& face = mesh.face[h / 3];
    const int i = h % 3, o = left.opposite[h];
    face.V(i) = &mesh.vert[new_vertex[left.vertex[h]]];
    face.FFp(i) = o < 0 ? &face : &mesh.face[o / 3];
    face.FFi(i) = static_cast<char>(o < 0 ? i : o % 3);
  }
  return coarse;
}

}  // namespace dcharts
