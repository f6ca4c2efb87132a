// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "pattern/flat_charts.h"

namespace dcharts {

/// Per vertex of a chart the triangles around it, while triangles are parted: half-edges are found by looking
/// at those alone.
class FacesAround {
 public:
  explicit FacesAround(const FlatChart& chart) : chart_(chart), faces_(chart.uv.rows()) {
    for (int f = 0; f < static_cast<int>(chart.mesh.triangles.rows()); ++f)
      for (int k = 0; k < 3; ++k) faces_[chart.mesh.triangles(f, k)].push_back(f);
  }

  const std::vector<int>& Around(int vertex) const { return faces_[vertex]; }

  /// The half-edge from a vertex to another; -1: there is none.
  int HalfEdge(int start, int end) const {
    int found = -1;
    for (const int f : faces_[start])
      for (int h = 3 * f; h < 3 * f + 3; ++h)
        if (StartOf(chart_, h) == start && EndOf(chart_, h) == end && (found < 0 || h < found)) found = h;
    return found;
  }

  /// To be called when the chart has a new vertex, its last.
  void AddVertex() { faces_.emplace_back(); }

  /// To be called when triangle `f` was made two by `vertex` on one of its edges: the other one is the
  /// chart's last.
  void AddParted(int f, int vertex) {
    const int g = static_cast<int>(chart_.mesh.triangles.rows()) - 1;
    faces_[vertex].push_back(f);
    for (int k = 0; k < 3; ++k) {
      const int v = chart_.mesh.triangles(g, k);
      faces_[v].push_back(g);
      if (v != vertex && !HasCorner(f, v)) faces_[v].erase(std::find(faces_[v].begin(), faces_[v].end(), f));
    }
  }

 private:
  bool HasCorner(int f, int v) const {
    for (int k = 0; k < 3; ++k)
      if (chart_.mesh.triangles(f, k) == v) return true;
    return false;
  }

  const FlatChart& chart_;
  std::vector<std::vector<int>> faces_;
};

}  // namespace dcharts
