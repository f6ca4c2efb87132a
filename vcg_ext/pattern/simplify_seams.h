// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "pattern/flat_charts.h"
#include "pattern/seam_graph.h"

namespace dcharts {

struct SimplifyOptions {
  double tolerance = 0;  ///< how far a dropped vertex may be from the new edge, on each side, mm
  double most_ease =
      0.004;  ///< how much the lengths of the two sides' new edges may differ, as a share of the 3D length
};

/// Per seam, per vertex of it: whether it stays.
using KeptVertices = std::vector<std::vector<char>>;

/// Simplifies the outlines of all pieces by vertex collapse (Section 4, "Simplifying boundaries"), at once on
/// all sides of a seam, so that they keep the same number of points. A vertex costs the areas of the
/// triangles that it forms with its neighbours on each side; the cheapest goes first, and half its cost is
/// added to each neighbour. The ends of seams stay, a closed seam keeps three vertices and every outline
/// three corners. No outline gets to cross itself or another of its piece that did not before.
KeptVertices SimplifySeams(const FlatCharts& charts, const SeamGraph& graph, const SimplifyOptions& options,
                           const std::function<void()>& poll);

}  // namespace dcharts
