// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/map_from_coarser.h"

#include "planar/vertex_descent.h"

namespace dcharts {

bool IsLargeChart(const ChartMesh& chart) {
  constexpr int kManyTriangles = 30000;
  return chart.triangles.rows() > kManyTriangles;
}

CoarseChart CoarserChart(const ChartMesh& chart, const std::function<void()>& poll) {
  constexpr int kCoarser = 4;  // times fewer triangles
  return CoarseChart(chart, static_cast<int>(chart.triangles.rows()) / kCoarser, poll);
}

std::optional<PlanePoints> MapFromCoarser(const ChartMesh& chart, const CoarseChart* known,
                                          const std::function<Points2(const ChartMesh&)>& flatten,
                                          const std::function<void()>& poll, RestShapes& shapes) {
  if (poll) poll();
  std::optional<CoarseChart> made;
  if (!known) made.emplace(CoarserChart(chart, poll));
  const CoarseChart& coarse = known ? *known : *made;
  if (2 * coarse.Mesh().triangles.rows() > chart.triangles.rows()) return std::nullopt;
  const Points2 flat = flatten(coarse.Mesh());
  if (flat.rows() == 0) return std::nullopt;
  std::optional<PlanePoints> uv = coarse.Continued(flat, poll);
  if (!uv) return std::nullopt;
  RelaxSlivers(chart.triangles, *uv, shapes);
  VertexSweeps(static_cast<int>(uv->size()), chart.triangles, shapes).EvenOut(poll, *uv);
  return uv;
}

}  // namespace dcharts
