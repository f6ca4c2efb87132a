// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/carried_map.h"

#include <algorithm>
#include <vector>

#include "planar/extend_map.h"

namespace dcharts {
namespace {

// Places the vertices of the given triangles that have no place yet; false when that can't be done.
bool LayBeside(const ChartPatch& patch, const std::vector<int>& triangles, std::vector<bool>& placed,
               Points2& uv) {
  std::vector<int> local(patch.VertexCount(), -1), vertices;
  MapEdge edge;
  edge.mesh.triangles.resize(static_cast<int>(triangles.size()), 3);
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      const int v = patch.mesh.triangles(triangles[t], i);
      if (local[v] < 0) {
        local[v] = static_cast<int>(vertices.size());
        vertices.push_back(v);
      }
      edge.mesh.triangles(t, i) = local[v];
    }
  edge.mesh.positions.resize(static_cast<int>(vertices.size()), 3);
  for (int k = 0; k < static_cast<int>(vertices.size()); ++k) {
    const int v = vertices[k];
    edge.mesh.positions.row(k) = patch.mesh.positions.row(v);
    edge.placed.push_back(placed[v]);
    edge.fixed.push_back(placed[v]);
    edge.uv.push_back({uv(v, 0), uv(v, 1)});
  }
  ExtendMap(edge);
  for (int k = 0; k < static_cast<int>(vertices.size()); ++k) {
    if (!edge.placed[k]) return false;
    uv(vertices[k], 0) = edge.uv[k].real();
    uv(vertices[k], 1) = edge.uv[k].imag();
  }
  return true;
}

}  // namespace

Points2 CarriedMap(const ChartPatch& from, const Points2& uv, const ChartPatch& to) {
  Points2 result = Points2::Zero(to.VertexCount(), 2);
  std::vector<bool> placed(to.VertexCount(), false);
  std::vector<int> others;
  size_t f = 0;
  for (int t = 0; t < static_cast<int>(to.faces.size()); ++t) {
    while (f < from.faces.size() && from.faces[f] < to.faces[t]) ++f;
    if (f == from.faces.size() || from.faces[f] != to.faces[t]) {
      others.push_back(t);
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      const int v = to.mesh.triangles(t, i);
      result.row(v) = uv.row(from.mesh.triangles(static_cast<int>(f), i));
      placed[v] = true;
    }
  }
  if (!others.empty() && !LayBeside(to, others, placed, result)) return {};
  return result;
}

}  // namespace dcharts
