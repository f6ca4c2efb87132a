// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vcg/complex/complex.h>
#include <vcg/simplex/face/topology.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/half_edge.h"

namespace dcharts {

/// What the stages ask of a mesh, face by face, in flat arrays. READS the mesh's coordinates and face-face
/// topology. A half-edge h = 3 f + i is edge (i, i+1) of face f. Odd edges, those with more than two faces or
/// with faces that disagree in orientation, count as borders: charts never grow across them.
template <class MeshType>
class SurfaceGraph {
 public:
  explicit SurfaceGraph(const MeshType& mesh) {
    using Face = typename MeshType::FaceType;
    const int face_count = static_cast<int>(mesh.face.size());
    vertex_.resize(3 * face_count);
    opposite_.assign(3 * face_count, -1);
    length_.resize(3 * face_count);
    step_.assign(3 * face_count, 0);
    normal_.resize(face_count);
    area_.resize(face_count);
    centroid_.resize(face_count);
    position_.resize(mesh.vert.size());
    for (size_t v = 0; v < mesh.vert.size(); ++v) {
      const auto& p = mesh.vert[v].cP();
      position_[v] = {p[0], p[1], p[2]};
    }
    for (int f = 0; f < face_count; ++f) {
      const Face& face = mesh.face[f];
      for (int i = 0; i < 3; ++i) {
        vertex_[3 * f + i] = static_cast<int>(vcg::tri::Index(mesh, face.cV(i)));
        const Face* other = face.cFFp(i);
        const int j = face.cFFi(i);
        const bool border = other == &face;
        const bool manifold = !border && other->cFFp(j) == &face && other->cFFi(j) == i;
        if (manifold && other->cV(j) == face.cV1(i) && other->cV1(j) == face.cV(i))
          opposite_[3 * f + i] = 3 * static_cast<int>(vcg::tri::Index(mesh, other)) + j;
      }
    }
    for (int f = 0; f < face_count; ++f) {
      const auto &a = Position(f, 0), &b = Position(f, 1), &c = Position(f, 2);
      const Eigen::Vector3d n = (b - a).cross(c - a);
      const double norm = n.norm();
      area_[f] = norm / 2;
      total_area_ += area_[f];
      normal_[f] = norm > 1e-18 ? Eigen::Vector3d(n / norm) : Eigen::Vector3d::Zero();
      centroid_[f] = (a + b + c) / 3;
      for (int i = 0; i < 3; ++i) length_[3 * f + i] = (Position(f, (i + 1) % 3) - Position(f, i)).norm();
    }
    for (int f = 0; f < face_count; ++f)
      for (int i = 0; i < 3; ++i)
        if (opposite_[3 * f + i] < 0 && IsOddEdge(mesh, f, i)) odd_edges_length_ += length_[3 * f + i];
    for (int h = 0; h < 3 * face_count; ++h)
      if (opposite_[h] >= 0) step_[h] = (centroid_[h / 3] - centroid_[opposite_[h] / 3]).norm();

    ring_start_.assign(VertexCount() + 1, 0);
    for (int v : vertex_) ++ring_start_[v + 1];
    for (int v = 0; v < VertexCount(); ++v) ring_start_[v + 1] += ring_start_[v];
    ring_.resize(vertex_.size());
    std::vector<int> fill(ring_start_.begin(), ring_start_.end() - 1);
    for (int h = 0; h < HalfEdgeCount(); ++h) ring_[fill[vertex_[h]]++] = h;
  }

  /// Makes edges borders: bit i of a face's mask is edge (i, i+1); either side's bit will do.
  void Part(const std::vector<std::uint8_t>& edges) {
    for (int h = 0; h < HalfEdgeCount(); ++h)
      if ((edges[h / 3] >> (h % 3) & 1) != 0 && opposite_[h] >= 0) {
        parted_.push_back({h, opposite_[h]});
        opposite_[opposite_[h]] = -1;
        opposite_[h] = -1;
      }
  }
  /// The edges that Part made borders, by their half-edges, since the last RejoinParted.
  const std::vector<std::pair<int, int>>& Parted() const { return parted_; }
  void RejoinParted() {
    for (const auto& [h, o] : parted_) {
      opposite_[h] = o;
      opposite_[o] = h;
    }
    parted_.clear();
  }

  int FaceCount() const { return static_cast<int>(area_.size()); }
  int HalfEdgeCount() const { return static_cast<int>(vertex_.size()); }
  int VertexCount() const { return static_cast<int>(position_.size()); }

  int Vertex(int half_edge) const { return vertex_[half_edge]; }      ///< where the half-edge starts
  int Opposite(int half_edge) const { return opposite_[half_edge]; }  ///< -1 at a border
  int Neighbour(int half_edge) const { return opposite_[half_edge] < 0 ? -1 : opposite_[half_edge] / 3; }
  double Length(int half_edge) const { return length_[half_edge]; }
  double Step(int half_edge) const { return step_[half_edge]; }  ///< between the centroids of its two faces

  double Area(int face) const { return area_[face]; }
  double TotalArea() const { return total_area_; }
  double OddEdgesLength() const { return odd_edges_length_; }              ///< each edge once
  const Eigen::Vector3d& Normal(int face) const { return normal_[face]; }  ///< zero for a face without area
  /// Other normals than those of the triangles, one per face: without noise, say.
  void SetNormals(std::vector<Eigen::Vector3d> normals) { normal_ = std::move(normals); }
  const Eigen::Vector3d& Centroid(int face) const { return centroid_[face]; }
  const Eigen::Vector3d& Position(int vertex) const { return position_[vertex]; }
  /// The half-edges that start at a vertex, as [begin, end): one per face around it.
  const int* RingBegin(int vertex) const { return ring_.data() + ring_start_[vertex]; }
  const int* RingEnd(int vertex) const { return ring_.data() + ring_start_[vertex + 1]; }

  const Eigen::Vector3d& Position(int face, int corner) const {
    return position_[vertex_[3 * face + corner]];
  }

 private:
  // With faces on it, of which this is the first.
  static bool IsOddEdge(const MeshType& mesh, int face, int edge) {
    const auto* other = mesh.face[face].cFFp(edge);
    int at = mesh.face[face].cFFi(edge);
    if (other == &mesh.face[face]) return false;
    while (other != &mesh.face[face]) {
      if (static_cast<int>(vcg::tri::Index(mesh, other)) < face) return false;
      const int next = other->cFFi(at);
      other = other->cFFp(at);
      at = next;
    }
    return true;
  }

  std::vector<int> vertex_, opposite_, ring_start_, ring_;
  std::vector<double> length_, step_, area_;
  std::vector<Eigen::Vector3d> normal_, centroid_, position_;
  double total_area_ = 0, odd_edges_length_ = 0;
  std::vector<std::pair<int, int>> parted_;
};

}  // namespace dcharts
