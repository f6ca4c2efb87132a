// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numeric>
#include <utility>

#include "planar/min_cut.h"

namespace dcharts {
namespace {

// The edges at each node.
struct Adjacency {
  std::vector<int> first, edge;

  Adjacency(int node_count, const std::vector<FlowEdge>& edges) : first(node_count + 1, 0) {
    for (const FlowEdge& e : edges) {
      ++first[e.a + 1];
      ++first[e.b + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<int> next(first.begin(), first.end() - 1);
    edge.resize(2 * edges.size());
    for (int e = 0; e < static_cast<int>(edges.size()); ++e) {
      edge[next[edges[e].a]++] = e;
      edge[next[edges[e].b]++] = e;
    }
  }
};

int Other(const FlowEdge& edge, int node) { return edge.a == node ? edge.b : edge.a; }

// Calls visit(node, other end of an edge) for all edges at a node.
template <class Visit>
void ForEachNeighbour(int node, const Adjacency& adjacency, const std::vector<FlowEdge>& edges,
                      const Visit& visit) {
  for (int k = adjacency.first[node]; k < adjacency.first[node + 1]; ++k)
    visit(Other(edges[adjacency.edge[k]], node));
}

// Nodes that hang together in groups of a few, grown from the nodes in their order; returns how many.
int Groups(const Adjacency& adjacency, const std::vector<FlowEdge>& edges, std::vector<int>& group) {
  constexpr size_t kNodes = 12;
  const int node_count = static_cast<int>(adjacency.first.size()) - 1;
  group.assign(node_count, -1);
  int count = 0;
  std::vector<int> members;
  for (int start = 0; start < node_count; ++start) {
    if (group[start] >= 0) continue;
    members.assign(1, start);
    group[start] = count;
    for (size_t k = 0; k < members.size() && members.size() < kNodes; ++k)
      ForEachNeighbour(members[k], adjacency, edges, [&](int n) {
        if (group[n] >= 0 || members.size() == kNodes) return;
        group[n] = count;
        members.push_back(n);
      });
    ++count;
  }
  return count;
}

// The cut of the graph in which each group is one node.
std::vector<bool> CutOfGroups(const std::vector<double>& pull, const std::vector<FlowEdge>& edges,
                              const std::vector<int>& group, int count, const std::function<void()>& poll) {
  std::vector<double> pull_of_group(count, 0);
  for (size_t n = 0; n < pull.size(); ++n) pull_of_group[group[n]] += pull[n];
  std::vector<FlowEdge> between;
  for (const FlowEdge& e : edges) {
    const auto [a, b] = std::minmax(group[e.a], group[e.b]);
    if (a != b) between.push_back({a, b, e.capacity});
  }
  std::stable_sort(between.begin(), between.end(), [](const FlowEdge& x, const FlowEdge& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  std::vector<FlowEdge> joined;
  for (const FlowEdge& e : between) {
    if (!joined.empty() && joined.back().a == e.a && joined.back().b == e.b)
      joined.back().capacity += e.capacity;
    else
      joined.push_back(e);
  }
  poll();
  return BandedMinCut(pull_of_group, joined, poll);
}

}  // namespace

std::vector<bool> BandedMinCut(const std::vector<double>& pull, const std::vector<FlowEdge>& edges,
                               const std::function<void()>& poll) {
  constexpr size_t kManyNodes = 10000;
  if (pull.size() <= kManyNodes) return MinCut(pull, edges);
  const Adjacency adjacency(static_cast<int>(pull.size()), edges);
  std::vector<int> group;
  const int count = Groups(adjacency, edges, group);
  poll();
  if (2 * static_cast<size_t>(count) > pull.size()) return MinCut(pull, edges);
  const std::vector<bool> of_groups = CutOfGroups(pull, edges, group, count, poll);
  poll();
  std::vector<bool> side(pull.size());
  for (size_t n = 0; n < side.size(); ++n) side[n] = of_groups[group[n]];

  // Free are the nodes a few steps from the cut.
  constexpr int kSteps = 10;
  std::vector<int> free, place(pull.size(), -1);
  const auto set_free = [&](int n) {
    if (place[n] >= 0) return;
    place[n] = static_cast<int>(free.size());
    free.push_back(n);
  };
  for (const FlowEdge& e : edges)
    if (side[e.a] != side[e.b]) {
      set_free(e.a);
      set_free(e.b);
    }
  size_t begin = 0;
  for (int step = 0; step < kSteps; ++step) {
    const size_t end = free.size();
    for (; begin < end; ++begin) ForEachNeighbour(free[begin], adjacency, edges, set_free);
  }
  std::vector<double> pull_of_free;
  for (int n : free) pull_of_free.push_back(pull[n]);
  std::vector<FlowEdge> between;
  for (const FlowEdge& e : edges) {
    const int a = place[e.a], b = place[e.b];
    if (a >= 0 && b >= 0)
      between.push_back({a, b, e.capacity});
    else if (a >= 0)
      pull_of_free[a] += side[e.b] ? e.capacity : -e.capacity;
    else if (b >= 0)
      pull_of_free[b] += side[e.a] ? e.capacity : -e.capacity;
  }
  poll();
  const std::vector<bool> of_free = MinCut(pull_of_free, between);
  for (size_t k = 0; k < free.size(); ++k) side[free[k]] = of_free[k];
  return side;
}

}  // namespace dcharts
