// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/seam_graph.h"

#include <algorithm>

namespace dcharts {
namespace {

class SeamChainer {
 public:
  explicit SeamChainer(const FlatCharts& charts) : charts_(charts) {
    std::vector<std::vector<char>> is_boundary;
    for (const FlatChart& chart : charts.charts) {
      edge_of_.emplace_back(3 * chart.mesh.triangles.rows(), -1);
      is_boundary.emplace_back(3 * chart.mesh.triangles.rows(), 0);
    }
    for (size_t e = 0; e < charts.edges.size(); ++e)
      for (const ChartEdge& side : charts.edges[e]) {
        edge_of_[side.chart][side.half_edge] = static_cast<int>(e);
        is_boundary[side.chart][side.half_edge] = 1;
      }
    for (size_t c = 0; c < charts.charts.size(); ++c)
      boundary_.push_back(BoundaryOf(charts.charts[c], is_boundary[c]));
  }

  SeamGraph Run() {
    SeamGraph graph;
    for (const auto& edges : edge_of_) graph.places.emplace_back(edges.size());
    std::vector<char> taken(charts_.edges.size(), 0);
    // Seams with ends first, then the closed ones.
    for (const bool closed : {false, true})
      for (int e = 0; e < static_cast<int>(charts_.edges.size()); ++e) {
        if (taken[e] || (!closed && Continuation(FirstWay(e), true).edge >= 0)) continue;
        FineSeam seam;
        seam.closed = closed;
        std::vector<Way> ways;
        for (Way way = FirstWay(e); way.edge >= 0 && !taken[way.edge]; way = Continuation(way, false)) {
          taken[way.edge] = 1;
          ways.push_back(way);
        }
        AddSeam(ways, seam, graph);
      }
    return graph;
  }

 private:
  /// An edge with its sides in the order of the seam's, seen in the seam's direction.
  struct Way {
    int edge = -1;
    std::vector<ChartEdge> sides{};
    std::vector<char> backwards{};
  };

  const FlatChart& Chart(const ChartEdge& side) const { return charts_.charts[side.chart]; }

  int ModelStart(const ChartEdge& side) const {
    return Chart(side).model_vertex[StartOf(Chart(side), side.half_edge)];
  }

  // The edge in the direction in which it has no predecessor, if there is one.
  Way FirstWay(int e) const {
    Way way = InDirection(e, false);
    if (Continuation(way, true).edge < 0) return way;
    Way turned = InDirection(e, true);
    return Continuation(turned, true).edge < 0 ? turned : way;
  }

  Way InDirection(int e, bool turned) const {
    Way way;
    way.edge = e;
    way.sides = charts_.edges[e];
    const int start = ModelStart(way.sides.front());
    for (const ChartEdge& side : way.sides)
      way.backwards.push_back((ModelStart(side) != start) != turned ? 1 : 0);
    return way;
  }

  // The edge that all sides go on with, or come from; edge -1 when they part there.
  Way Continuation(const Way& way, bool before) const {
    Way next;
    for (size_t k = 0; k < way.sides.size(); ++k) {
      const ChartEdge& side = way.sides[k];
      const FlatChart& chart = Chart(side);
      const ChartBoundary& boundary = boundary_[side.chart];
      const bool forward = (way.backwards[k] != 0) == before;
      const int h = forward ? boundary.leaving[EndOf(chart, side.half_edge)]
                            : boundary.arriving[StartOf(chart, side.half_edge)];
      if (h < 0) return {};
      const int e = edge_of_[side.chart][h];
      if (e == way.edge || charts_.edges[e].size() != way.sides.size()) return {};
      if (k == 0)
        next.edge = e;
      else if (next.edge != e)
        return {};
      for (const ChartEdge& other : next.sides)  // one edge between two sides of this one
        if (other.chart == side.chart && other.half_edge == h) return {};
      next.sides.push_back({side.chart, h});
    }
    next.backwards = way.backwards;
    return next;
  }

  void AddSeam(const std::vector<Way>& ways, FineSeam& seam, SeamGraph& graph) const {
    const int id = static_cast<int>(graph.seams.size());
    const size_t side_count = ways.front().sides.size();
    seam.sides.resize(side_count);
    seam.arc.push_back(0);
    for (size_t k = 0; k < ways.size(); ++k) {
      double length = 0;
      for (size_t j = 0; j < side_count; ++j) {
        const ChartEdge& edge = ways[k].sides[j];
        const FlatChart& chart = Chart(edge);
        FineSide& side = seam.sides[j];
        side.chart = edge.chart;
        side.backwards = ways[k].backwards[j] != 0;
        int from = StartOf(chart, edge.half_edge), to = EndOf(chart, edge.half_edge);
        if (side.backwards) std::swap(from, to);
        if (k == 0) side.vertices.push_back(from);
        side.vertices.push_back(to);
        length = (chart.mesh.positions.row(from) - chart.mesh.positions.row(to)).norm();
        graph.places[edge.chart][edge.half_edge] = {id, static_cast<int>(j), static_cast<int>(k)};
      }
      seam.arc.push_back(seam.arc.back() + length);
    }
    graph.seams.push_back(std::move(seam));
  }

  const FlatCharts& charts_;
  std::vector<std::vector<int>> edge_of_;  // per chart, per half-edge
  std::vector<ChartBoundary> boundary_;
};

}  // namespace

ChartBoundary BoundaryOf(const FlatChart& chart, const std::vector<char>& is_boundary) {
  ChartBoundary boundary;
  boundary.leaving.assign(chart.mesh.positions.rows(), -1);
  boundary.arriving = boundary.leaving;
  for (int h = 0; h < static_cast<int>(is_boundary.size()); ++h) {
    if (!is_boundary[h]) continue;
    boundary.leaving[StartOf(chart, h)] = h;
    boundary.arriving[EndOf(chart, h)] = h;
  }
  return boundary;
}

SeamGraph SeamsOf(const FlatCharts& charts) { return SeamChainer(charts).Run(); }

}  // namespace dcharts
