// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/chart_ids.h"
#include "planar/collapsing_mesh.h"

namespace dcharts {

/// The lines along which charts meet each other or the mesh's border, while edges are collapsed. A line runs
/// from corner to corner (three or more charts or borders meet there, or the mesh isn't manifold), or it is a
/// closed loop without one.
class BorderLines {
 public:
  /// `fixed`: per vertex, corners whatever the charts are. All must outlive this object.
  BorderLines(const CollapsingMesh& mesh, const ChartIds& ids, const std::vector<char>& fixed);

  bool IsBorder(int half_edge) const {
    const int o = mesh_.Opposite(half_edge);
    return o < 0 || ids_[o / 3] != ids_[half_edge / 3];
  }
  bool IsCorner(int v) const { return kind_[v] == kCorner; }

  /// Whether u may move along the edge: inside a chart anywhere, on a line along it while it has edges to
  /// spare.
  bool MayCollapse(int u, const CollapsingMesh::Spoke& e) const {
    if (kind_[u] == kInside) return true;
    return kind_[u] == kOnLine && IsBorder(e.half_edge) && edges_[line_[u]] > least_[line_[u]];
  }

  /// To be told when u has moved.
  void Collapsed(int u) {
    if (kind_[u] == kOnLine) --edges_[line_[u]];
  }

 private:
  enum Kind : char { kInside, kOnLine, kCorner };

  const CollapsingMesh& mesh_;
  const ChartIds& ids_;
  std::vector<Kind> kind_;
  std::vector<int> line_;           // per vertex on a line
  std::vector<int> edges_, least_;  // per line
};

}  // namespace dcharts
