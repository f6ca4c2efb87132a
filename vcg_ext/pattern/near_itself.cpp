// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/near_itself.h"

#include <algorithm>
#include <cmath>

#include "pattern/seam_graph.h"
#include "pattern/segments.h"

namespace dcharts {
namespace {

/// An edge of the outline, the chart on its left.
struct Edge {
  int half_edge = 0, loop = 0;
  Point2 from{0, 0}, to{0, 0};
  double along = 0;  // where its middle is, along the loop
};

struct Loops {
  std::vector<Edge> edges;
  std::vector<double> length;
};

Loops LoopsOf(const FlatChart& chart, const std::vector<int>& boundary) {
  std::vector<char> is_boundary(3 * static_cast<size_t>(chart.mesh.triangles.rows()), 0);
  for (int h : boundary) is_boundary[h] = 1;
  const ChartBoundary next = BoundaryOf(chart, is_boundary);
  Loops loops;
  std::vector<char> done(is_boundary.size(), 0);
  for (int first : boundary) {
    if (done[first]) continue;
    double along = 0;
    for (int h = first; !done[h]; h = next.leaving[EndOf(chart, h)]) {
      done[h] = 1;
      Edge edge;
      edge.half_edge = h;
      edge.loop = static_cast<int>(loops.length.size());
      edge.from = chart.uv.row(StartOf(chart, h)).transpose();
      edge.to = chart.uv.row(EndOf(chart, h)).transpose();
      const double length = (edge.to - edge.from).norm();
      edge.along = along + length / 2;
      along += length;
      loops.edges.push_back(edge);
    }
    loops.length.push_back(along);
  }
  return loops;
}

// Whether p is on the outer side of the edge.
bool IsBeyond(const Edge& edge, const Point2& p) { return Orient(edge.from, edge.to, p) < 0; }

}  // namespace

std::optional<std::pair<int, int>> NearItself(const FlatChart& chart, const std::vector<int>& boundary,
                                              const std::vector<char>& is_cut, double distance) {
  const double far = 10 * distance;  // along the outline
  const Loops loops = LoopsOf(chart, boundary);
  std::optional<std::pair<int, int>> nearest;
  for (size_t i = 0; i < loops.edges.size(); ++i)
    for (size_t j = i + 1; j < loops.edges.size(); ++j) {
      const Edge &a = loops.edges[i], &b = loops.edges[j];
      if (a.loop != b.loop || (is_cut[a.half_edge] && is_cut[b.half_edge])) continue;
      const double apart = std::abs(a.along - b.along);
      if (std::min(apart, loops.length[a.loop] - apart) < far) continue;
      const Point2 p = (a.from + a.to) / 2, q = (b.from + b.to) / 2;
      if (!IsBeyond(a, q) || !IsBeyond(b, p)) continue;
      const double d =
          std::min({DistanceToSegment(a.from, b.from, b.to), DistanceToSegment(a.to, b.from, b.to),
                    DistanceToSegment(b.from, a.from, a.to), DistanceToSegment(b.to, a.from, a.to)});
      if (d >= distance) continue;
      distance = d;
      nearest = {a.half_edge, b.half_edge};
    }
  return nearest;
}

}  // namespace dcharts
