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
  struct Arc {
    int from, to;
    double capacity;
    int partner;
  };
  std::vector<Arc> arcs;
  arcs.reserve(2 * (edges.size() + pull.size()));
  auto add = [&](int a, int b, double forward, double backward) {
    const int k = static_cast<int>(arcs.size());
    arcs.push_back({a, b, forward, k + 1});
    arcs.push_back({b, a, backward, k});
  };
  for (const FlowEdge& e : edges) add(e.a, e.b, e.capacity, e.capacity);
  for (int n = 0; n < node_count; ++n) {
    if (pull[n] > 0) add(source, n, pull[n], 0);
    if (pull[n] < 0) add(n, sink, -pull[n], 0);
  }
  const int arc_count = static_cast<int>(arcs.size());
  std::vector<int> order(arc_count), place(arc_count), next(node_count + 3, 0);
  for (const Arc& arc : arcs) ++next[arc.from + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (int k = 0; k < arc_count; ++k) order[next[arcs[k].from]++] = k;
  std::vector<std::pair<int, int>> ends(arc_count);
  std::vector<double> capacity(arc_count), residual(arc_count);
  for (int k = 0; k < arc_count; ++k) {
    place[order[k]] = k;
    ends[k] = {arcs[order[k]].from, arcs[order[k]].to};
    capacity[k] = arcs[order[k]].capacity;
  }
  const Graph graph(boost::edges_are_sorted, ends.begin(), ends.end(), node_count + 2);
  std::vector<Graph::edge_descriptor> descriptor(arc_count), reverse(arc_count);
  const auto edge_index = boost::get(boost::edge_index, graph);
  for (auto [it, end] = boost::edges(graph); it != end; ++it) descriptor[get(edge_index, *it)] = *it;
  for (int k = 0; k < arc_count; ++k) reverse[k] = descriptor[place[arcs[order[k]].partner]];

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
