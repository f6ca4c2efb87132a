// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/min_cut.h"

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>

#include <numeric>
#include <utility>

namespace dcharts {

std::vector<bool> MinCut(int node_count, const std::vector<FlowEdge>& edges, const std::vector<int>& sources,
                         const std::vector<int>& sinks) {
  double total = 1;
  for (const FlowEdge& e : edges) total += e.capacity;
  std::vector<double> pull(node_count, 0);
  for (int s : sources) pull[s] = total;
  for (int t : sinks) pull[t] = -total;
  return MinCut(pull, edges);
}

std::vector<bool> MinCut(const std::vector<double>& pull, const std::vector<FlowEdge>& edges) {
  using Graph =
      boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property, int, int>;
  const int node_count = static_cast<int>(pull.size());
  const int source = node_count, sink = node_count + 1;

  // Each undirected edge is two arcs; a terminal's arc has a partner without capacity. Sorted by start, as
  // CSR wants.
  std::vector<int> next(node_count + 3, 0);
  const auto for_arcs = [&](const auto& visit) {  // start, end, capacity, that of the partner
    for (const FlowEdge& e : edges) visit(e.a, e.b, e.capacity, e.capacity);
    for (int n = 0; n < node_count; ++n) {
      if (pull[n] > 0) visit(source, n, pull[n], 0.0);
      if (pull[n] < 0) visit(n, sink, -pull[n], 0.0);
    }
  };
  for_arcs([&](int a, int b, double, double) {
    ++next[a + 1];
    ++next[b + 1];
  });
  std::partial_sum(next.begin(), next.end(), next.begin());
  const int arc_count = next[node_count + 2];
  std::vector<std::pair<int, int>> ends(arc_count);
  std::vector<double> capacity(arc_count), residual(arc_count);
  std::vector<Graph::edge_descriptor> reverse(arc_count);
  for_arcs([&](int a, int b, double forward, double backward) {
    const int there = next[a]++, back = next[b]++;
    ends[there] = {a, b};
    ends[back] = {b, a};
    capacity[there] = forward;
    capacity[back] = backward;
    reverse[there] = Graph::edge_descriptor(b, back);
    reverse[back] = Graph::edge_descriptor(a, there);
  });
  const Graph graph(boost::edges_are_sorted, ends.begin(), ends.end(), node_count + 2);
  const auto edge_index = boost::get(boost::edge_index, graph);

  std::vector<boost::default_color_type> color(node_count + 2);
  std::vector<double> distance(node_count + 2);
  std::vector<Graph::edge_descriptor> predecessor(node_count + 2);
  const auto vertex_index = boost::get(boost::vertex_index, graph);
  boost::boykov_kolmogorov_max_flow(graph, boost::make_iterator_property_map(capacity.begin(), edge_index),
                                    boost::make_iterator_property_map(residual.begin(), edge_index),
                                    boost::make_iterator_property_map(reverse.begin(), edge_index),
                                    boost::make_iterator_property_map(predecessor.begin(), vertex_index),
                                    boost::make_iterator_property_map(color.begin(), vertex_index),
                                    boost::make_iterator_property_map(distance.begin(), vertex_index),
                                    vertex_index, source, sink);

  std::vector<bool> with_source(node_count);
  for (int n = 0; n < node_count; ++n) with_source[n] = color[n] == color[source];
  return with_source;
}

}  // namespace dcharts
