// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "planar/extend_map.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"

namespace dcharts {

/// Where the faces of charts are on the maps of these.
template <class MeshType>
class ChartMaps {
 public:
  explicit ChartMaps(const SurfaceGraph<MeshType>& surface)
      : surface_(surface), map_of_(surface.FaceCount(), -1), uv_(surface.HalfEdgeCount()) {}

  void Forget() { std::fill(map_of_.begin(), map_of_.end(), -1); }
  /// `uv`: per vertex of the patch, in model units.
  void Set(int chart, const ChartPatch& patch, const Points2& uv) {
    for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
      const int v = patch.Vertex(h);
      uv_[patch.SurfaceHalfEdge(h)] = {uv(v, 0), uv(v, 1)};
      map_of_[patch.faces[h / 3]] = chart;
    }
  }

  /// A face that moved since the maps were made is on none.
  bool Hold(int f, int chart, const ChartIds& ids) const { return map_of_[f] == chart && ids[f] == chart; }
  const Complex& At(int half_edge) const { return uv_[half_edge]; }

  /// What a face costs on its own map.
  double Excess(int f) const {
    const Eigen::Vector3d e1 = surface_.Position(f, 1) - surface_.Position(f, 0),
                          e2 = surface_.Position(f, 2) - surface_.Position(f, 0);
    return DirichletExcess(e1, e2, uv_[3 * f + 1] - uv_[3 * f], uv_[3 * f + 2] - uv_[3 * f]);
  }

 private:
  const SurfaceGraph<MeshType>& surface_;
  std::vector<int> map_of_;  // per face: the chart on whose map it is
  std::vector<Complex> uv_;  // per corner, on that map
};

}  // namespace dcharts
