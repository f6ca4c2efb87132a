// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/half_edges.h"

namespace dcharts {

std::map<std::pair<int, int>, int> HalfEdges(const FlatChart& chart) {
  std::map<std::pair<int, int>, int> half_edges;
  for (int h = 0; h < 3 * static_cast<int>(chart.mesh.triangles.rows()); ++h)
    half_edges[{StartOf(chart, h), EndOf(chart, h)}] = h;
  return half_edges;
}

std::vector<int> OppositeHalfEdges(const FlatChart& chart) {
  const auto half_edges = HalfEdges(chart);
  std::vector<int> opposite(3 * static_cast<size_t>(chart.mesh.triangles.rows()), -1);
  for (const auto& [ends, h] : half_edges) {
    const auto other = half_edges.find({ends.second, ends.first});
    if (other != half_edges.end()) opposite[h] = other->second;
  }
  return opposite;
}

}  // namespace dcharts
