// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/border_lines.h"

#include "common/half_edge.h"
#include "common/union_find.h"

namespace dcharts {
namespace {

// A line of one edge would lose its shape, a loop of two has none.
constexpr int kLeastEdges = 2;
constexpr int kLeastLoopEdges = 3;

}  // namespace

BorderLines::BorderLines(const CollapsingMesh& mesh, const ChartIds& ids, const std::vector<char>& fixed)
    : mesh_(mesh), ids_(ids), kind_(fixed.size(), kInside), line_(fixed.size(), -1) {
  const int vertex_count = static_cast<int>(fixed.size()), half_edge_count = 3 * mesh.FaceCount();
  std::vector<int> borders;  // each edge once
  std::vector<int> border_count(vertex_count, 0);
  for (int h = 0; h < half_edge_count; ++h)
    if (mesh.Opposite(h) < h && IsBorder(h)) {
      borders.push_back(h);
      ++border_count[mesh.Vertex(h)];
      ++border_count[mesh.Vertex(Next(h))];
    }
  for (int v = 0; v < vertex_count; ++v)
    if (fixed[v] || border_count[v] > 2)
      kind_[v] = kCorner;
    else if (border_count[v] > 0)
      kind_[v] = kOnLine;

  UnionFind lines(vertex_count);
  for (int h : borders)
    if (kind_[mesh.Vertex(h)] == kOnLine && kind_[mesh.Vertex(Next(h))] == kOnLine)
      lines.Join(mesh.Vertex(h), mesh.Vertex(Next(h)));
  std::vector<int> line_of_root(vertex_count, -1);
  for (int v = 0; v < vertex_count; ++v) {
    if (kind_[v] != kOnLine) continue;
    int& line = line_of_root[lines.Find(v)];
    if (line < 0) {
      line = static_cast<int>(edges_.size());
      edges_.push_back(0);
    }
    line_[v] = line;
  }
  std::vector<int> end_corner(edges_.size(), -1);
  least_.assign(edges_.size(), kLeastLoopEdges);
  for (int h : borders) {
    const int a = mesh.Vertex(h), b = mesh.Vertex(Next(h));
    if (line_[a] < 0 && line_[b] < 0) continue;  // from corner to corner: stays as it is
    const int line = line_[a] >= 0 ? line_[a] : line_[b];
    ++edges_[line];
    if (line_[a] >= 0 && line_[b] >= 0) continue;
    const int corner = line_[a] >= 0 ? b : a;
    if (end_corner[line] < 0)
      end_corner[line] = corner;
    else if (end_corner[line] != corner)
      least_[line] = kLeastEdges;
  }
}

}  // namespace dcharts
