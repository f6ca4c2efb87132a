// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/map_from_coarser.h"

#include "planar/vertex_descent.h"

namespace dcharts {

std::optional<PlanePoints> MapFromCoarser(const ChartMesh& normalized, CoarserCharts& coarser,
                                          const std::function<Points2(const ChartMesh&)>& flatten,
                                          const std::function<void()>& poll, RestShapes& shapes) {
  if (poll) poll();
  const CoarseChart& quarter = coarser.Quarter(poll);
  if (2 * quarter.Mesh().triangles.rows() > normalized.triangles.rows()) return std::nullopt;
  const Points2 flat = flatten(quarter.Mesh());
  if (flat.rows() == 0) return std::nullopt;
  std::optional<PlanePoints> uv = quarter.Continued(flat, poll);
  if (!uv) return std::nullopt;
  RelaxSlivers(normalized.triangles, *uv, shapes);
  VertexSweeps(static_cast<int>(uv->size()), normalized.triangles, shapes).EvenOut(poll, *uv);
  return uv;
}

}  // namespace dcharts
