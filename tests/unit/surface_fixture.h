// SPDX-License-Identifier: GPL-3.0-or-later
/// What the tests of the stages have in common.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "common/params.h"
#include "common/pi.h"
#include "common/progress.h"
#include "shapes.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/surface_graph.h"
#include "surface/surface_mesh.h"

namespace dcharts::test {

/// A mesh as the stages see it: unit area, centred.
class TestSurface {
 public:
  explicit TestSurface(const SurfaceData& data) {
    BuildSurface(data, mesh_);
    graph_ = std::make_unique<SurfaceGraph<SurfaceMesh>>(mesh_);
    data_ = data;
  }
  const SurfaceGraph<SurfaceMesh>& operator*() const { return *graph_; }
  const SurfaceGraph<SurfaceMesh>* operator->() const { return graph_.get(); }

  /// Chart ids from the faces' centroids in the coordinates of the input.
  ChartIds Paint(const std::function<int(const std::array<double, 3>&)>& id_at) const {
    ChartIds ids;
    for (const auto& face : data_.faces) {
      std::array<double, 3> centroid{0, 0, 0};
      for (int v : face)
        for (size_t d = 0; d < 3; ++d) centroid[d] += data_.vertices[v][d] / 3;
      ids.push_back(id_at(centroid));
    }
    return ids;
  }

  /// A vertex of the input (the numbering is the same).
  const std::array<double, 3>& InputPosition(int vertex) const { return data_.vertices[vertex]; }
  const SurfaceData& Input() const { return data_; }

  /// Where an input length stands on the surface of unit area.
  double Scale() const { return graph_->Length(0) / InputLength(0); }

  double AreaOf(const ChartIds& ids, int id) const {
    double area = 0;
    for (int f = 0; f < graph_->FaceCount(); ++f)
      if (ids[f] == id) area += graph_->Area(f);
    return area;
  }

  ChartPatch Patch(const ChartIds& ids, const SeamMask& seams, int id) const {
    return PatchExtractor<SurfaceMesh>(*graph_, seams).Extract(FacesOfCharts(ids)[id]);
  }
  ChartPatch WholePatch() const {
    return Patch(ChartIds(graph_->FaceCount(), 0), SeamMask(graph_->FaceCount(), 0), 0);
  }

 private:
  double InputLength(int half_edge) const {
    const auto &a = data_.vertices[data_.faces[half_edge / 3][half_edge % 3]],
               &b = data_.vertices[data_.faces[half_edge / 3][(half_edge + 1) % 3]];
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }

  SurfaceMesh mesh_;
  std::unique_ptr<SurfaceGraph<SurfaceMesh>> graph_;
  SurfaceData data_;
};

/// A ramp that winds around an axis. Laid flat without stretch, more than one turn lies on itself.
inline SurfaceData Ramp(double turns, int columns = 60, int rows = 3) {
  SurfaceData mesh = shapes::Grid(columns, rows);
  for (auto& p : mesh.vertices) {
    const double angle = 2 * kPi * turns * p[0], radius = 1 + 0.5 * p[1];
    p = {radius * std::cos(angle), radius * std::sin(angle), 0.05 * angle};
  }
  return mesh;
}

/// Which side of the unit cube a point is on, 0..5.
inline int CubeSide(const std::array<double, 3>& p, const std::array<double, 3>& centre, double half) {
  int best = 0;
  for (int d = 0; d < 3; ++d)
    for (int s : {0, 1})
      if (std::abs((s ? 1 : -1) * (p[d] - centre[d]) - half) < 1e-6) best = 2 * d + s;
  return best;
}

/// True when every chart is connected and holds a face.
inline bool ChartsAreWhole(const SurfaceGraph<SurfaceMesh>& surface, const ChartIds& ids) {
  ChartIds split = ids;
  SplitAndCompact(surface, split);
  return ChartCount(split) == ChartCount(ids);
}

}  // namespace dcharts::test
