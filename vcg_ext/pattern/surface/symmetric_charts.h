// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params.h"
#include "common/progress.h"
#include "pattern/surface/mirrored_halves.h"
#include "surface/charts.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// Charts of a symmetric mesh, made of charts that take no notice of that: each is the mirror image of
/// another, or its own (see JoinAtPlane). Those of the half with shorter seams stay. A chart's part beyond
/// the plane, and what the plane cuts off, goes to a neighbour where both lie flat. Leaves `ids` and `seams`
/// alone, and returns false, when there would be far too many charts.
bool MakeChartsSymmetric(const SurfaceGraph<SurfaceMesh>& surface, const MirroredHalves& halves,
                         const Params& params, Progress& progress, ChartIds& ids, SeamMask& seams);

}  // namespace dcharts
