// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params.h"
#include "common/progress.h"
#include "surface/straighten_graph_cut.h"
#include "surface/straighten_shortest_path.h"

namespace dcharts {

/// Straightens the borders between charts by params.straighten_by. Every face must have a chart, every chart
/// be one piece; charts keep their ids.
template <class MeshType>
void StraightenBorders(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress,
                       ChartIds& ids) {
  if (params.straighten_by == StraightenMethod::kGraphCut)
    GraphCutStraightener<MeshType>(surface, BorderCutOptions{}, progress).Run(ids);
  else
    ShortestPathStraightener<MeshType>(surface, params, progress).Run(ids);
}

}  // namespace dcharts
