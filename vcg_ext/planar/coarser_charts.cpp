// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/coarser_charts.h"

#include <cstddef>
#include <utility>

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

CoarserCharts& CoarserCharts::OfQuarter(const std::function<void()>& poll) {
  if (!of_quarter_) of_quarter_ = std::make_unique<CoarserCharts>(Normalized(Quarter(poll).Mesh()));
  return *of_quarter_;
}

const FewTriangles& CoarserCharts::ForTrials(const std::function<void()>& poll) {
  if (for_trials_) return *for_trials_;
  const CoarseChart& quarter = Quarter(poll);
  FewTriangles few;
  if (IsLargeChart(quarter.Mesh())) {
    few = OfQuarter(poll).ForTrials(poll);
  } else {
    constexpr int kEnoughFaces = 8000;
    const CoarseChart coarse(quarter.Mesh(), kEnoughFaces, poll);
    few = {coarse.Mesh(), coarse.Opposite(), coarse.SourceVertices(), coarse.SourceFaces()};
  }
  for (int& v : few.source_vertex) v = quarter.SourceVertices()[static_cast<std::size_t>(v)];
  for (int& f : few.source_face) f = quarter.SourceFaces()[static_cast<std::size_t>(f)];
  return for_trials_.emplace(std::move(few));
}

}  // namespace dcharts
