// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params.h"
#include "common/progress.h"
#include "common/report.h"
#include "surface/charts.h"
#include "surface/charts_for.h"
#include "surface/known_flattenings.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// The stages from Segment to Cut, one after the other (Section 3): `ids` and `seams` are set. They take the
/// first `share` (0..1) of the progress. Flattenings made on the way are left in `known`.
void MakeCharts(const SurfaceGraph<SurfaceMesh>& surface, const Params& params, ChartsFor use, double share,
                Progress& progress, ChartIds& ids, SeamMask& seams, KnownFlattenings& known, Report& report);

}  // namespace dcharts
