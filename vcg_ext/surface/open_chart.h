// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "surface/chart_patch.h"

namespace dcharts {

/// Edges (local half-edges, one per edge) to cut so that the patch has no handle and at least one boundary
/// loop; empty when that is so already. Handles are opened along short loops found by tree and cotree
/// (Erickson and Whittlesey 2005: a shortest-path tree, and a maximum spanning tree of the dual; each edge in
/// neither closes one loop). A closed sphere gets a slit between two far points.
std::vector<int> CutsThatOpenHandles(const ChartPatch& patch);

/// Edges to cut so that boundary loops are joined by the shortest cuts (Section 3.3, "cuts connecting the
/// chart boundary loops"). A hole in a part that is flat around it needs no cut and gets none, unless
/// `to_disk`. The patch must have no handle.
std::vector<int> CutsThatJoinLoops(const ChartPatch& patch, bool to_disk);

/// Sum of the corner angles at each vertex, radians.
std::vector<double> AngleSums(const ChartPatch& patch);

}  // namespace dcharts
