// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "surface/chart_patch.h"

namespace dcharts {

/// Parts a chart so that faces that overlap in the plane come to different sides, by the shortest seam
/// (min-cut over edge lengths). `overlaps`: pairs of local faces, not empty. Returns per local face 0 or 1;
/// both occur.
std::vector<int> SplitAtOverlaps(const ChartPatch& patch, const std::vector<std::pair<int, int>>& overlaps);

/// Parts a chart of two or more faces between two far faces, by the shortest seam about half-way. `poll` is
/// called now and then and may throw.
std::vector<int> Bisect(const ChartPatch& patch, const std::function<void()>& poll = {});

/// The same between two given faces, `a` on side 0 and `b` on side 1.
std::vector<int> BisectBetween(const ChartPatch& patch, int a, int b);

/// The faces on side 1 become chart `new_id`.
void GiveSideAnId(const ChartPatch& patch, const std::vector<int>& side, int new_id, ChartIds& ids);

/// The same, and the edges between the sides become seams.
void PartChart(const ChartPatch& patch, const std::vector<int>& side, int new_id, ChartIds& ids,
               SeamMask& seams);

}  // namespace dcharts
