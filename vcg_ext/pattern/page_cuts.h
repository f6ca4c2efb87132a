// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "pattern/flat_charts.h"

namespace dcharts {

/// How many pages of this size a piece with these points takes when it is tiled, turned as it suits; 1: it
/// fits.
int PagesFor(const Polyline& points, const Point2& page);
int PagesFor(const FlatChart& chart, const Point2& page);

/// Parts charts that do not fit into `page` (mm) along straight lines until all do: into as few parts as a
/// search of lines finds, across narrow places. Both sides of such a seam are equally long. Returns the
/// number of cuts. Throws Error when they would be more than 120 parts. `poll` may throw.
int CutToPages(const Point2& page, const std::function<void()>& poll, FlatCharts& charts);

}  // namespace dcharts
