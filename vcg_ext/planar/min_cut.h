// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace dcharts {

/// An undirected edge of a flow network.
struct FlowEdge {
  int a, b;
  double capacity;  ///< >= 0
};

/// The cheapest set of edges that separates `sources` from `sinks` (disjoint, neither empty) in a graph of
/// `node_count` nodes. Returns per node whether it is on the sources' side.
std::vector<bool> MinCut(int node_count, const std::vector<FlowEdge>& edges, const std::vector<int>& sources,
                         const std::vector<int>& sinks);

}  // namespace dcharts
