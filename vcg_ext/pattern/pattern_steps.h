// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params.h"
#include "common/progress.h"
#include "pattern/flat_charts.h"
#include "pattern/pattern.h"

namespace dcharts {

/// From flat charts to a finished pattern, all but `piece_of_face` and `scale`. Takes [from, to] (0..1) of
/// the progress. Throws Error, Cancelled.
Pattern PatternOfCharts(FlatCharts charts, const Params& params, Progress& progress, double from, double to);

}  // namespace dcharts
