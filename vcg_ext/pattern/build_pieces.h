// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pattern/flat_charts.h"
#include "pattern/pattern.h"
#include "pattern/seam_graph.h"
#include "pattern/simplify_seams.h"

namespace dcharts {

/// Pieces with their net outlines, areas, flat meshes and darts, and seams with their sides, lengths and
/// ease. The pieces are in the order of the charts, the seams in that of the graph.
Pattern BuildPieces(const FlatCharts& charts, const SeamGraph& graph, const KeptVertices& kept);

/// Sets the lengths of seams' sides, eases, net areas and darts from the outlines.
void MeasurePieces(Pattern& pattern);

}  // namespace dcharts
