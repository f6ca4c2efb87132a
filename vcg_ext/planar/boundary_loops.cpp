// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/boundary_loops.h"

#include <algorithm>
#include <utility>

namespace dcharts {
namespace {

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

// The directed edges of the triangles, by the vertex they leave and by the one they come to.
class DirectedEdges {
 public:
  DirectedEdges(const Triangles& triangles, int vertex_count)
      : start_(At(vertex_count) + 1, 0), to_(At(3 * triangles.rows())), from_(to_.size()) {
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k) ++start_[At(triangles(t, k)) + 1];
    }
    for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
    std::vector<int> end(start_.begin(), start_.end() - 1);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const std::size_t at = At(end[At(triangles(t, k))]++);
        to_[at] = triangles(t, (k + 1) % 3);
        from_[at] = triangles(t, (k + 2) % 3);
      }
    }
  }

  int VertexCount() const { return static_cast<int>(start_.size()) - 1; }

  bool HaveDuplicates() const {
    std::vector<int> last_from(start_.size(), -1);
    for (int v = 0; v < VertexCount(); ++v) {
      for (int i = start_[At(v)]; i < start_[At(v) + 1]; ++i) {
        int& from = last_from[At(to_[At(i)])];
        if (from == v) return true;
        from = v;
      }
    }
    return false;
  }

  // The one boundary edge that leaves each vertex, -1 for interior vertices; `count` receives how many leave.
  std::vector<int> BoundarySuccessors(std::vector<int>& count) const {
    std::vector<int> next(At(VertexCount()), -1);
    count.assign(At(VertexCount()), 0);
    std::vector<int> comes_to(At(VertexCount()), -1);
    for (int v = 0; v < VertexCount(); ++v) {
      for (int i = start_[At(v)]; i < start_[At(v) + 1]; ++i) comes_to[At(from_[At(i)])] = v;
      for (int i = start_[At(v)]; i < start_[At(v) + 1]; ++i) {
        if (comes_to[At(to_[At(i)])] == v) continue;
        next[At(v)] = to_[At(i)];
        ++count[At(v)];
      }
    }
    return next;
  }

 private:
  std::vector<int> start_;  // of each vertex in to_ and from_, and the end
  std::vector<int> to_, from_;
};

std::vector<std::vector<int>> LoopsOf(std::vector<int> next) {
  std::vector<std::vector<int>> loops;
  for (int v = 0; v < static_cast<int>(next.size()); ++v) {
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

int Find(std::vector<int>& parent, int v) {
  while (parent[At(v)] != v) {
    parent[At(v)] = parent[At(parent[At(v)])];
    v = parent[At(v)];
  }
  return v;
}

}  // namespace

std::vector<std::vector<int>> BoundaryLoops(const Triangles& triangles) {
  std::vector<int> count;
  return LoopsOf(DirectedEdges(triangles, triangles.maxCoeff() + 1).BoundarySuccessors(count));
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
  const DirectedEdges edges(triangles, static_cast<int>(vertex_count));
  if (edges.HaveDuplicates()) {
    return "An edge of the chart has more than two triangles, or two that are turned against each other.";
  }
  std::vector<int> count;
  const std::vector<int> next = edges.BoundarySuccessors(count);
  Eigen::Index boundary_edges = 0;
  for (const int leaving : count) {
    if (leaving > 1) return "Two boundary loops of the chart touch in a vertex.";
    boundary_edges += leaving;
  }
  if (boundary_edges == 0) return "The chart is closed: it has to be cut open before it can be flattened.";
  // Each edge with two triangles was counted twice.
  const Eigen::Index edge_count = (3 * triangles.rows() + boundary_edges) / 2;
  const Eigen::Index loops = static_cast<Eigen::Index>(LoopsOf(next).size());
  if (vertex_count - edge_count + triangles.rows() != 2 - loops) {
    return "The chart has a handle or a vertex where it only touches itself: it has to be cut before it can "
           "be flattened.";
  }
  return {};
}

}  // namespace dcharts
