// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "planar/chart_mesh.h"
#include "surface/charts.h"
#include "common/union_find.h"

namespace dcharts {

/// Corners of faces glued over all edges that are neither seam nor border: the vertices of the mesh cut open.
/// Each is a fan of faces, also where the mesh has a non-manifold vertex.
struct CutVertices {
  std::vector<int> of_corner;  ///< per corner 3 f + i: its cut vertex; numbered by first corner
  int count = 0;
};

template <class MeshType>
CutVertices OpenAtSeams(const SurfaceGraph<MeshType>& surface, const SeamMask& seams) {
  UnionFind sets(surface.HalfEdgeCount());
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int o = surface.Opposite(h);
    if (o < h || IsSeam(seams, h)) continue;
    sets.Join(h, Next(o));
    sets.Join(Next(h), o);
  }
  CutVertices cut;
  cut.of_corner.resize(surface.HalfEdgeCount());
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int root = sets.Find(h);
    cut.of_corner[h] = root == h ? cut.count++ : cut.of_corner[root];
  }
  return cut;
}

/// One chart, cut open along the seams, with its own numbering and topology.
struct ChartPatch {
  std::vector<int> faces;       ///< face of the surface per local face
  ChartMesh mesh;               ///< positions and triangles, local
  std::vector<int> opposite;    ///< per local half-edge 3 f + i, -1 at the chart's boundary
  std::vector<int> cut_vertex;  ///< per local vertex, its number in CutVertices

  int HalfEdgeCount() const { return static_cast<int>(opposite.size()); }
  int VertexCount() const { return static_cast<int>(mesh.positions.rows()); }
  int Vertex(int half_edge) const { return mesh.triangles(half_edge / 3, half_edge % 3); }
  int SurfaceHalfEdge(int half_edge) const { return 3 * faces[half_edge / 3] + half_edge % 3; }
  double Length(int half_edge) const {
    return (mesh.positions.row(Vertex(half_edge)) - mesh.positions.row(Vertex(Next(half_edge)))).norm();
  }
  double FaceArea(int face) const {
    const Eigen::Vector3d a = mesh.positions.row(mesh.triangles(face, 0)),
                          b = mesh.positions.row(mesh.triangles(face, 1)),
                          c = mesh.positions.row(mesh.triangles(face, 2));
    return (b - a).cross(c - a).norm() / 2;
  }
  double Area() const {
    double area = 0;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f) area += FaceArea(f);
    return area;
  }
};

/// Takes charts out of a surface. Keeps its maps, so that many small charts cost only their own size.
template <class MeshType>
class PatchExtractor {
 public:
  PatchExtractor(const SurfaceGraph<MeshType>& surface, const CutVertices& cut, const SeamMask& seams)
      : surface_(surface),
        cut_(cut),
        seams_(seams),
        local_vertex_(cut.count, -1),
        local_face_(surface.FaceCount(), -1) {}

  ChartPatch Extract(const std::vector<int>& faces) {
    ChartPatch patch;
    patch.faces = faces;
    const int face_count = static_cast<int>(faces.size());
    patch.mesh.triangles.resize(face_count, 3);
    for (int f = 0; f < face_count; ++f) {
      local_face_[faces[f]] = f;
      for (int i = 0; i < 3; ++i) {
        int& local = local_vertex_[cut_.of_corner[3 * faces[f] + i]];
        if (local < 0) {
          local = static_cast<int>(patch.cut_vertex.size());
          patch.cut_vertex.push_back(cut_.of_corner[3 * faces[f] + i]);
          positions_.push_back(surface_.Position(faces[f], i));
        }
        patch.mesh.triangles(f, i) = local;
      }
    }
    patch.mesh.positions.resize(static_cast<Eigen::Index>(positions_.size()), 3);
    for (size_t v = 0; v < positions_.size(); ++v) patch.mesh.positions.row(v) = positions_[v];
    patch.opposite.assign(3 * face_count, -1);
    for (int h = 0; h < 3 * face_count; ++h) {
      const int s = patch.SurfaceHalfEdge(h), o = surface_.Opposite(s);
      if (o >= 0 && !IsSeam(seams_, s)) patch.opposite[h] = 3 * local_face_[o / 3] + o % 3;
    }
    for (int v : patch.cut_vertex) local_vertex_[v] = -1;
    for (int f : faces) local_face_[f] = -1;
    positions_.clear();
    return patch;
  }

 private:
  const SurfaceGraph<MeshType>& surface_;
  const CutVertices& cut_;
  const SeamMask& seams_;
  std::vector<int> local_vertex_, local_face_;
  std::vector<Eigen::Vector3d> positions_;
};

}  // namespace dcharts
