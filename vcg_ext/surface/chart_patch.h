// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "common/parallel.h"
#include "common/union_find.h"
#include "planar/chart_mesh.h"
#include "surface/charts.h"

namespace dcharts {

/// Corners of faces glued over all edges that are neither seam nor border: the vertices of the mesh cut open.
/// Each is a fan of faces, also where the mesh has a non-manifold vertex.
struct CutVertices {
  std::vector<int> of_corner;  ///< per corner 3 f + i: its cut vertex; numbered by first corner
  int count = 0;
};

/// Of half-edges with `opposite(h)` across (-1: none).
template <class Opposite>
CutVertices GlueCorners(int half_edge_count, const Opposite& opposite) {
  UnionFind sets(half_edge_count);
  for (int h = 0; h < half_edge_count; ++h) {
    const int o = opposite(h);
    if (o < h) continue;
    sets.Join(h, Next(o));
    sets.Join(Next(h), o);
  }
  CutVertices cut;
  cut.of_corner.resize(half_edge_count);
  for (int h = 0; h < half_edge_count; ++h) {
    const int root = sets.Find(h);
    cut.of_corner[h] = root == h ? cut.count++ : cut.of_corner[root];
  }
  return cut;
}

template <class MeshType>
CutVertices OpenAtSeams(const SurfaceGraph<MeshType>& surface, const SeamMask& seams) {
  return GlueCorners(surface.HalfEdgeCount(),
                     [&](int h) { return IsSeam(seams, h) ? -1 : surface.Opposite(h); });
}

/// One chart, cut open along the seams, with its own numbering and topology.
struct ChartPatch {
  std::vector<int> faces;     ///< face of the surface per local face
  ChartMesh mesh;             ///< positions and triangles, local
  std::vector<int> opposite;  ///< per local half-edge 3 f + i, -1 at the chart's boundary

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
  double Diagonal() const {  ///< of the bounding box
    return (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
  }
  double Area() const {
    double area = 0;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f) area += FaceArea(f);
    return area;
  }
};

/// The patch cut open along `edges` (its half-edges, one per edge or both).
ChartPatch CutOpen(const ChartPatch& patch, const std::vector<int>& edges);

/// Takes charts out of a surface. Keeps its map, so that many small charts cost only their own size.
template <class MeshType>
class PatchExtractor {
 public:
  /// Of fewer faces, what is done once per chart is not worth a thread.
  static constexpr int kManyFaces = 20000;

  /// Both must outlive the extractor.
  PatchExtractor(const SurfaceGraph<MeshType>& surface, const SeamMask& seams)
      : surface_(surface), seams_(seams), local_face_(surface.FaceCount(), -1) {}

  /// `faces`: one chart, or several that are to be seen as one where no seam is between them.
  ChartPatch Extract(const std::vector<int>& faces) {
    Number(faces, 0);
    ChartPatch patch = Numbered(faces, 0);
    Forget(faces);
    return patch;
  }

  /// Several charts, none of which has faces of another: on all threads, where they are large.
  std::vector<ChartPatch> ExtractAll(const std::vector<std::vector<int>>& charts) {
    const int count = static_cast<int>(charts.size());
    std::vector<int> begin{0};  // of the numbers of their faces
    for (const std::vector<int>& faces : charts)
      begin.push_back(begin.back() + static_cast<int>(faces.size()));
    std::vector<ChartPatch> patches(charts.size());
    for (int k = 0; k < count; ++k) Number(charts[k], begin[k]);
    InParallelIf(begin.back() >= kManyFaces, count, {},
                 [&](int k, const auto&) { patches[k] = Numbered(charts[k], begin[k]); });
    for (const std::vector<int>& faces : charts) Forget(faces);
    return patches;
  }

 private:
  void Number(const std::vector<int>& faces, int first) {
    for (int f : faces) local_face_[f] = first++;
  }

  void Forget(const std::vector<int>& faces) {
    for (int f : faces) local_face_[f] = -1;
  }

  ChartPatch Numbered(const std::vector<int>& faces, int first) const {
    ChartPatch patch;
    patch.faces = faces;
    const int face_count = static_cast<int>(faces.size());
    patch.opposite.assign(3 * face_count, -1);
    for (int h = 0; h < 3 * face_count; ++h) {
      const int s = patch.SurfaceHalfEdge(h), o = surface_.Opposite(s);
      if (o < 0 || IsSeam(seams_, s)) continue;
      const int g = local_face_[o / 3] - first;
      if (g >= 0 && g < face_count) patch.opposite[h] = 3 * g + o % 3;
    }
    const CutVertices cut = GlueCorners(patch.HalfEdgeCount(), [&](int h) { return patch.opposite[h]; });
    patch.mesh.triangles.resize(face_count, 3);
    patch.mesh.positions.resize(cut.count, 3);
    for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
      patch.mesh.triangles(h / 3, h % 3) = cut.of_corner[h];
      patch.mesh.positions.row(cut.of_corner[h]) = surface_.Position(faces[h / 3], h % 3);
    }
    return patch;
  }

  const SurfaceGraph<MeshType>& surface_;
  const SeamMask& seams_;
  std::vector<int> local_face_;  // -1 for faces of no chart that is taken out
};

}  // namespace dcharts
