// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params.h"
#include "common/progress.h"
#include "pattern/surface/mirrored_halves.h"
#include "surface/charts.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// Charts that meet their mirror images at the plane are joined with them where both lie flat, within the
/// bound on stretch and as params.method lays them, with cuts that are their own mirror images: a chart that
/// would go round a hole stays open along the plane. `ids` and `seams` are of charts that end at the plane,
/// and symmetric; they are so afterwards.
void JoinAtPlane(const SurfaceGraph<SurfaceMesh>& surface, const MirroredHalves& halves, const Params& params,
                 Progress& progress, ChartIds& ids, SeamMask& seams);

}  // namespace dcharts
