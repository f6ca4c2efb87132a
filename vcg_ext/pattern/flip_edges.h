// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "pattern/flat_charts.h"

namespace dcharts {

/// Makes the triangles of each face that was parted less narrow, by flipping edges between parts of one face
/// as long as that raises their least angle (Delaunay). The surface, its map and all other edges stay. Cuts
/// along straight lines would else make ever more and ever narrower triangles. `kept`: pairs of vertices
/// whose edge stays.
void FlipEdges(const std::vector<std::pair<int, int>>& kept, FlatChart& chart);

}  // namespace dcharts
