// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/coarser_charts.h"

namespace dcharts {

bool IsLargeChart(const ChartMesh& chart) {
  constexpr int kManyTriangles = 30000;
  return chart.triangles.rows() > kManyTriangles;
}

const CoarseChart& CoarserCharts::Quarter(const std::function<void()>& poll) {
  constexpr int kTimesFewer = 4;
  if (!quarter_)
    quarter_.emplace(normalized_.mesh, static_cast<int>(normalized_.mesh.triangles.rows()) / kTimesFewer,
                     poll);
  return *quarter_;
}

const CoarseChart& CoarserCharts::ForTrials(const std::function<void()>& poll) {
  constexpr int kEnoughFaces = 8000;
  if (!for_trials_) for_trials_.emplace(Quarter(poll).Mesh(), kEnoughFaces, poll);
  return *for_trials_;
}

}  // namespace dcharts
