// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/map_from_coarser.h"

#include "planar/vertex_descent.h"

namespace dcharts {

std::optional<PlanePoints> MapFromCoarser(const NormalizedChart& chart, CoarserCharts* known,
                                          const FlattenCoarser& flatten, const std::function<void()>& poll,
                                          RestShapes& shapes) {
  if (poll) poll();
  std::optional<CoarserCharts> made;
  CoarserCharts& coarser = known ? *known : made.emplace(chart);
  const CoarseChart& quarter = coarser.Quarter(poll);
  const Triangles& triangles = chart.mesh.triangles;
  if (2 * quarter.Mesh().triangles.rows() > triangles.rows()) return std::nullopt;
  const Points2 flat =
      flatten(quarter.Mesh(), IsLargeChart(quarter.Mesh()) ? &coarser.OfQuarter(poll) : nullptr);
  if (flat.rows() == 0) return std::nullopt;
  std::optional<PlanePoints> uv = quarter.Continued(flat, poll);
  if (!uv) return std::nullopt;
  RelaxSlivers(triangles, *uv, shapes);
  VertexSweeps(static_cast<int>(uv->size()), triangles, shapes).EvenOut(poll, *uv);
  return uv;
}

}  // namespace dcharts
