// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace dcharts {

/// The triangles of a surface while edges are collapsed. Half-edge h = 3 f + i is edge (i, i+1) of face f.
/// Every vertex that is moved, or moved onto, must be one fan of faces, see OpenAtSeams.
class CollapsingMesh {
 public:
  /// An edge at a vertex: the vertex it leads to, and one of its half-edges, in either direction.
  struct Spoke {
    int vertex;
    int half_edge;
  };

  /// `vertex`: per half-edge, where it starts. `opposite`: per half-edge, -1 at a border; symmetric.
  CollapsingMesh(std::vector<int> vertex, std::vector<int> opposite, int vertex_count);

  int FaceCount() const { return live_faces_; }
  bool FaceLives(int f) const { return vertex_[3 * f] >= 0; }
  bool VertexLives(int v) const { return out_[v] >= 0; }
  int Vertex(int half_edge) const { return vertex_[half_edge]; }
  int Opposite(int half_edge) const { return opposite_[half_edge]; }

  /// The edges at v in counterclockwise order, from border to border if it has one.
  void Spokes(int v, std::vector<Spoke>& spokes) const;
  /// The half-edges that start at v, in the same order: one per face.
  void Outgoing(int v, std::vector<int>& half_edges) const;

  /// Whether the surface keeps its topology when u moves onto the other end of edge `e` (link condition).
  /// Leaves out what concerns borders: two border vertices may be joined only along a border loop of four or
  /// more edges.
  bool MayCollapse(int u, const Spoke& e);

  /// Moves u onto e.vertex and takes out the faces at the edge.
  void Collapse(int u, const Spoke& e);

 private:
  void TakeOut(int half_edge);
  void SetOutgoing(int v, int half_edge);

  std::vector<int> vertex_, opposite_, out_;
  int live_faces_;
  std::vector<Spoke> spokes_u_, spokes_v_;
  std::vector<int> ring_u_, ring_v_, mark_;
  int marks_ = 0;
};

}  // namespace dcharts
