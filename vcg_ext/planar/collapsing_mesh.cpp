// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/collapsing_mesh.h"

#include <utility>

#include "common/half_edge.h"

namespace dcharts {

CollapsingMesh::CollapsingMesh(std::vector<int> vertex, std::vector<int> opposite, int vertex_count)
    : vertex_(std::move(vertex)),
      opposite_(std::move(opposite)),
      out_(vertex_count, -1),
      live_faces_(static_cast<int>(vertex_.size()) / 3),
      mark_(vertex_count, 0) {
  for (int h = 0; h < static_cast<int>(vertex_.size()); ++h)
    if (out_[vertex_[h]] < 0) SetOutgoing(vertex_[h], h);
}

void CollapsingMesh::Outgoing(int v, std::vector<int>& half_edges) const {
  half_edges.clear();
  const int start = out_[v];
  int h = start;
  do {
    half_edges.push_back(h);
    h = opposite_[Previous(h)];
  } while (h >= 0 && h != start);
}

void CollapsingMesh::Spokes(int v, std::vector<Spoke>& spokes) const {
  spokes.clear();
  const int start = out_[v];
  int h = start;
  do {
    spokes.push_back({vertex_[Next(h)], h});
    const int in = Previous(h);
    h = opposite_[in];
    if (h < 0) spokes.push_back({vertex_[in], in});
  } while (h >= 0 && h != start);
}

bool CollapsingMesh::MayCollapse(int u, const Spoke& e) {
  Spokes(u, spokes_u_);
  Spokes(e.vertex, spokes_v_);
  ++marks_;
  int edges = 0;
  for (const Spoke& s : spokes_u_) {
    mark_[s.vertex] = marks_;
    edges += s.vertex == e.vertex;
  }
  int common = 0;
  for (const Spoke& s : spokes_v_) common += mark_[s.vertex] == marks_;
  const bool border = opposite_[e.half_edge] < 0;
  const bool tetrahedron = !border && spokes_u_.size() == 3 && spokes_v_.size() == 3;
  return edges == 1 && common == (border ? 1 : 2) && !tetrahedron;
}

void CollapsingMesh::Collapse(int u, const Spoke& e) {
  const int v = e.vertex, h = e.half_edge, o = opposite_[h];
  Outgoing(u, ring_u_);
  Outgoing(v, ring_v_);
  for (int g : ring_u_) vertex_[g] = v;
  out_[u] = -1;
  TakeOut(h);
  if (o >= 0) TakeOut(o);
  for (const std::vector<int>* ring : {&ring_v_, &ring_u_})
    for (int g : *ring)
      if (FaceLives(g / 3)) {
        SetOutgoing(v, g);
        return;
      }
}

// Glues the two other sides of the face at `half_edge` to each other.
void CollapsingMesh::TakeOut(int half_edge) {
  const int a = Next(half_edge), b = Previous(half_edge);
  const int apex = vertex_[b], oa = opposite_[a], ob = opposite_[b];
  if (oa >= 0) opposite_[oa] = ob;
  if (ob >= 0) opposite_[ob] = oa;
  vertex_[a] = vertex_[b] = vertex_[half_edge] = -1;
  --live_faces_;
  if (oa >= 0)
    SetOutgoing(apex, oa);
  else if (ob >= 0)
    SetOutgoing(apex, Next(ob));
}

// Rings are walked counterclockwise, so they start at the border on the clockwise side.
void CollapsingMesh::SetOutgoing(int v, int half_edge) {
  int h = half_edge;
  while (opposite_[h] >= 0) {
    h = Next(opposite_[h]);
    if (h == half_edge) break;
  }
  out_[v] = h;
}

}  // namespace dcharts
