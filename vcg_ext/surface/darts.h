// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/params.h"
#include "surface/chart_patch.h"

namespace dcharts {

/// The darts of one chart.
struct Darts {
  std::vector<int> edges;  ///< local half-edges to cut, one per edge
  int count = 0;
};

/// Darts and gussets (Section 3.3): cuts from the boundary to places that won't lie flat. Those are regions
/// of faces with a fitting error above params.dart_fitting_error, and single vertices whose angles don't add
/// up to 2 pi (a closed cone fits its proxy exactly, yet needs a cut to its apex). Each cut relieves a disk
/// around its tip as wide as the cut is long, so a long region gets several. None is longer than
/// params.max_dart_percent of the chart's bounding box diagonal. `fitting_error`: per local face, against the
/// chart's proxy. The patch must have a boundary.
Darts PlanDarts(const ChartPatch& patch, const std::vector<double>& fitting_error, const Params& params);

}  // namespace dcharts
