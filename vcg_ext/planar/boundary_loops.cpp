// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/boundary_loops.h"

#include <algorithm>
#include <cstdint>

namespace dcharts {
namespace {

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

struct HalfEdge {
  int from = 0, to = 0;
  std::uint64_t Key() const { return Key(from, to); }
  std::uint64_t Reverse() const { return Key(to, from); }
  static std::uint64_t Key(int a, int b) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) | static_cast<std::uint32_t>(b);
  }
};

std::vector<HalfEdge> HalfEdges(const Triangles& triangles) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * At(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) edges.push_back({triangles(t, k), triangles(t, (k + 1) % 3)});
  }
  return edges;
}

std::vector<std::uint64_t> SortedKeys(const std::vector<HalfEdge>& edges) {
  std::vector<std::uint64_t> keys;
  keys.reserve(edges.size());
  for (const HalfEdge& edge : edges) keys.push_back(edge.Key());
  std::sort(keys.begin(), keys.end());
  return keys;
}

// The one boundary edge that leaves each vertex, -1 for interior vertices; `count` receives how many leave.
std::vector<int> BoundarySuccessors(const Triangles& triangles, int vertex_count, std::vector<int>& count) {
  const std::vector<HalfEdge> edges = HalfEdges(triangles);
  const std::vector<std::uint64_t> keys = SortedKeys(edges);
  std::vector<int> next(At(vertex_count), -1);
  count.assign(At(vertex_count), 0);
  for (const HalfEdge& edge : edges) {
    if (std::binary_search(keys.begin(), keys.end(), edge.Reverse())) continue;
    next[At(edge.from)] = edge.to;
    ++count[At(edge.from)];
  }
  return next;
}

int Find(std::vector<int>& parent, int v) {
  while (parent[At(v)] != v) {
    parent[At(v)] = parent[At(parent[At(v)])];
    v = parent[At(v)];
  }
  return v;
}

}  // namespace

std::vector<std::vector<int>> BoundaryLoops(const Triangles& triangles) {
  const int vertex_count = triangles.maxCoeff() + 1;
  std::vector<int> count;
  std::vector<int> next = BoundarySuccessors(triangles, vertex_count, count);
  std::vector<std::vector<int>> loops;
  for (int v = 0; v < vertex_count; ++v) {
    if (next[At(v)] < 0) continue;
    std::vector<int> loop;
    for (int at = v; next[At(at)] >= 0;) {
      loop.push_back(at);
      const int after = next[At(at)];
      next[At(at)] = -1;
      at = after;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::string WhyNotAChart(const ChartMesh& chart) {
  const Triangles& triangles = chart.triangles;
  if (triangles.rows() == 0) return "The chart has no triangle.";
  const Eigen::Index vertex_count = chart.positions.rows();
  if (triangles.minCoeff() < 0 || triangles.maxCoeff() >= vertex_count) {
    return "A triangle of the chart uses a vertex that isn't there.";
  }
  for (Eigen::Index v = 0; v < vertex_count; ++v) {
    if (!chart.positions.row(v).allFinite()) return "The chart has a vertex that isn't a finite point.";
  }
  std::vector<int> parent(At(vertex_count));
  for (Eigen::Index v = 0; v < vertex_count; ++v) parent[At(v)] = static_cast<int>(v);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const int a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
    if (a == b || b == c || c == a) return "A triangle of the chart uses a vertex twice.";
    parent[At(Find(parent, b))] = Find(parent, a);
    parent[At(Find(parent, c))] = Find(parent, a);
  }
  for (Eigen::Index v = 1; v < vertex_count; ++v) {
    if (Find(parent, static_cast<int>(v)) != Find(parent, 0)) return "The chart isn't connected.";
  }
  const std::vector<HalfEdge> edges = HalfEdges(triangles);
  const std::vector<std::uint64_t> keys = SortedKeys(edges);
  if (std::adjacent_find(keys.begin(), keys.end()) != keys.end()) {
    return "An edge of the chart has more than two triangles, or two that are turned against each other.";
  }
  std::vector<int> count;
  const std::vector<int> next = BoundarySuccessors(triangles, static_cast<int>(vertex_count), count);
  Eigen::Index boundary_edges = 0;
  for (const int leaving : count) {
    if (leaving > 1) return "Two boundary loops of the chart touch in a vertex.";
    boundary_edges += leaving;
  }
  if (boundary_edges == 0) return "The chart is closed: it has to be cut open before it can be flattened.";
  // Each edge with two triangles was counted twice.
  const Eigen::Index edge_count = (3 * triangles.rows() + boundary_edges) / 2;
  const Eigen::Index loops = static_cast<Eigen::Index>(BoundaryLoops(triangles).size());
  if (vertex_count - edge_count + triangles.rows() != 2 - loops) {
    return "The chart has a handle or a vertex where it only touches itself: it has to be cut before it can "
           "be "
           "flattened.";
  }
  return {};
}

}  // namespace dcharts
