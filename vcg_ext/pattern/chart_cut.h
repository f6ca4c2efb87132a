// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pattern/flat_charts.h"

namespace dcharts {

/// Where a straight line crosses a boundary edge of a chart.
struct BoundaryCrossing {
  double along = 0;      ///< on the line, mm from its point `at`
  int half_edge = 0;     ///< of the chart
  double share = 0;      ///< of the edge that lies before the crossing
  bool leaving = false;  ///< the line leaves the chart here
};

/// A line in a chart's plane, `direction` of unit length.
struct PlaneLine {
  Point2 at{0, 0}, direction{1, 0};

  /// Distance of a point: positive to the left.
  double Off(const Point2& p) const {
    return direction.x() * (p.y() - at.y()) - direction.y() * (p.x() - at.x());
  }
};

/// All crossings with these half-edges, in the line's direction. A corner on the line counts as left of it.
std::vector<BoundaryCrossing> CrossingsOf(const FlatChart& chart, const std::vector<int>& boundary,
                                          const PlaneLine& line);

/// The boundary half-edge where a line leaves the chart that comes in across another: by way of the triangles
/// that it crosses, so also where rounding has it cross edges in another order. -1: nowhere.
int LeavesAt(const FlatChart& chart, const std::vector<int>& opposite, const PlaneLine& line, int half_edge);

/// Cuts a chart along a line from the first crossing to the second, between which the line is in the chart.
/// Edges are parted where the line crosses them, at the boundary also the other sides of the edge. What comes
/// apart becomes a chart of its own at the end of `charts`; the chart keeps its place. Returns the number of
/// parts: 2, or 1 where the cut only opens a hole.
int CutAlong(const PlaneLine& line, const BoundaryCrossing& from, const BoundaryCrossing& to, int chart,
             FlatCharts& charts);

}  // namespace dcharts
