// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
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

/// The cheapest way to part all nodes in two: pays the capacity of each edge between the sides and |pull| of
/// each node on the side it is not pulled to, which is the first for pull > 0, the second for pull < 0.
/// Returns per node whether it is on the first side, which is as small as it can be at that price.
std::vector<bool> MinCut(const std::vector<double>& pull, const std::vector<FlowEdge>& edges);

/// Nearly that in linear time, for large graphs of nodes that hang together: groups of nodes are parted
/// first, then the nodes near the cut [Lombaert et al., "A Multilevel Banded Graph Cuts Method", 2005]. Exact
/// below some 20,000 nodes. `poll` is called now and then and may throw.
std::vector<bool> BandedMinCut(
    const std::vector<double>& pull, const std::vector<FlowEdge>& edges,
    const std::function<void()>& poll = [] {});

}  // namespace dcharts
