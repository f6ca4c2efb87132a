// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/coarser_charts.h"

#include <cstddef>
#include <utility>

namespace dcharts {
namespace {

// `few`: of `finer`, which is of a chart.
FewTriangles WithSourcesOf(const FewTriangles& finer, FewTriangles few) {
  for (int& v : few.source_vertex) v = finer.source_vertex[static_cast<std::size_t>(v)];
  for (int& f : few.source_face) f = finer.source_face[static_cast<std::size_t>(f)];
  return few;
}

}  // namespace

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

const FewTriangles& CoarserCharts::LastQuarter(const std::function<void()>& poll) {
  if (last_quarter_) return *last_quarter_;
  const CoarseChart& quarter = Quarter(poll);
  FewTriangles few{quarter.Mesh(), quarter.Opposite(), quarter.SourceVertices(), quarter.SourceFaces()};
  if (IsLargeChart(quarter.Mesh())) few = WithSourcesOf(few, OfQuarter(poll).LastQuarter(poll));
  return last_quarter_.emplace(std::move(few));
}

const FewTriangles& CoarserCharts::ForTrials(const std::function<void()>& poll) {
  if (for_trials_) return *for_trials_;
  constexpr int kEnoughFaces = 8000;
  const FewTriangles& last = LastQuarter(poll);
  const CoarseChart coarse(last.mesh, kEnoughFaces, poll);
  return for_trials_.emplace(
      WithSourcesOf(last, {coarse.Mesh(), coarse.Opposite(), coarse.SourceVertices(), coarse.SourceFaces()}));
}

}  // namespace dcharts
