// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "common/params.h"
#include "common/progress.h"
#include "planar/cone_proxy.h"
#include "planar/min_cut.h"
#include "surface/chart_topology.h"
#include "surface/charts.h"
#include "surface/dual_distance.h"

namespace dcharts {

/// Straightening boundaries (Section 3.3): each boundary segment between two charts becomes the shortest path
/// through the fuzzy area; a boundary without end points (a loop) becomes the min-cut of the fuzzy area.
template <class MeshType>
class ShortestPathStraightener {
 public:
  ShortestPathStraightener(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface),
        params_(params),
        progress_(progress),
        distance_(surface),
        topology_(surface),
        fuzzy_(surface.FaceCount(), 0),
        side_(surface.FaceCount(), 0),
        on_path_(surface.HalfEdgeCount(), 0),
        vertex_distance_(surface.VertexCount(), kFar),
        vertex_from_(surface.VertexCount(), -1),
        vertex_mark_(surface.VertexCount(), 0) {}

  /// Every face must have a chart. No chart vanishes or falls apart, no boundary gets longer.
  void Run(ChartIds& ids) {
    Prepare(ids);
    const std::vector<Segment> segments = Segments(ids);
    for (size_t k = 0; k < segments.size(); ++k) {
      progress_.Update(static_cast<double>(k) / static_cast<double>(segments.size()));
      Straighten(segments[k], ids);
    }
    SplitAndCompact(surface_, ids);
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  /// Half-edges of chart `left` in a chain; chart `right` is across.
  struct Segment {
    int left, right;
    std::vector<int> edges;
    bool closed;
  };

  void Prepare(const ChartIds& ids) {
    chart_faces_ = FacesOfCharts(ids);
    proxy_.clear();
    chart_area_.clear();
    for (const auto& faces : chart_faces_) {
      NormalMoments moments;
      for (int f : faces) moments.Add(surface_.Area(f), surface_.Normal(f));
      proxy_.push_back(FitCone(moments));
      chart_area_.push_back(moments.area);
    }
    // A vertex where a segment runs on: two boundary edges and no border of the mesh.
    boundary_degree_.assign(surface_.VertexCount(), 0);
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int g = surface_.Opposite(h);
      if (g >= 0 && (h > g || ids[h / 3] == ids[g / 3])) continue;
      constexpr int kBorder = 1000;
      const int weight = g < 0 ? kBorder : 1;
      boundary_degree_[surface_.Vertex(h)] += weight;
      boundary_degree_[surface_.Vertex(Next(h))] += weight;
    }
  }

  bool Regular(int vertex) const { return boundary_degree_[vertex] == 2; }

  // The next half-edge of the same chart's boundary, around the end of `h`.
  int Follow(int h, const ChartIds& ids) const {
    int k = Next(h);
    while (surface_.Opposite(k) >= 0 && ids[surface_.Neighbour(k)] == ids[h / 3])
      k = Next(surface_.Opposite(k));
    return k;
  }

  std::vector<Segment> Segments(const ChartIds& ids) const {
    std::vector<Segment> segments;
    std::vector<char> done(surface_.HalfEdgeCount(), 0);
    auto borders = [&](int h) {
      return surface_.Opposite(h) >= 0 && ids[surface_.Neighbour(h)] > ids[h / 3];
    };
    auto trace = [&](int start, bool closed) {
      Segment s{ids[start / 3], ids[surface_.Neighbour(start)], {}, closed};
      int h = start;
      do {
        done[h] = 1;
        s.edges.push_back(h);
        const int end = surface_.Vertex(Next(h));
        if (!Regular(end)) break;
        h = Follow(h, ids);
      } while (!done[h]);
      segments.push_back(std::move(s));
    };
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h)
      if (borders(h) && !done[h] && !Regular(surface_.Vertex(h))) trace(h, false);
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h)
      if (borders(h) && !done[h]) trace(h, true);
    return segments;
  }

  void Straighten(const Segment& segment, ChartIds& ids) {
    if (segment.edges.size() < 2) return;
    MarkFuzzyArea(segment, ids);
    std::vector<int> to_left, to_right;  // faces that would change chart
    const bool found = segment.closed ? CutLoop(segment, ids, to_left, to_right)
                                      : ShortenSegment(segment, ids, to_left, to_right);
    if (found && (!to_left.empty() || !to_right.empty())) Apply(segment, to_left, to_right, ids);
  }

  // The faces that both charts could have: reached from the segment with F < F_max for both, and those that
  // touch the segment, so that the path there is always stays possible (filled faces exceed the bound). Not
  // deeper than a fraction of the smaller chart, so that none is swallowed.
  void MarkFuzzyArea(const Segment& s, const ChartIds& ids) {
    constexpr double kDepth = 0.25;
    depth_ = kDepth * std::sqrt(std::min(chart_area_[s.left], chart_area_[s.right]));
    auto of_pair = [&](int f) { return ids[f] == s.left || ids[f] == s.right; };
    std::vector<int> sources;
    for (int h : s.edges)
      for (int v : {surface_.Vertex(h), surface_.Vertex(Next(h))})
        for (const int* r = surface_.RingBegin(v); r != surface_.RingEnd(v); ++r)
          if (of_pair(*r / 3)) sources.push_back(*r / 3);
    distance_.Run(
        sources,
        [&](int f) {
          return of_pair(f) && FittingError(proxy_[s.left], surface_.Normal(f)) < params_.max_fitting_error &&
                 FittingError(proxy_[s.right], surface_.Normal(f)) < params_.max_fitting_error;
        },
        depth_);
    ++stamp_;
    for (int f : distance_.Reached()) fuzzy_[f] = stamp_;
  }

  bool Fuzzy(int f) const { return fuzzy_[f] == stamp_; }

  // Dijkstra along edges inside the fuzzy area from one end of the segment to the other; vertices of other
  // boundaries are no thoroughfare.
  bool ShortenSegment(const Segment& s, const ChartIds& ids, std::vector<int>& to_left,
                      std::vector<int>& to_right) {
    const int start = surface_.Vertex(s.edges.front()), end = surface_.Vertex(Next(s.edges.back()));
    if (start == end) return false;
    for (int h : s.edges) vertex_mark_[surface_.Vertex(h)] = stamp_;
    auto free = [&](int v) {
      return v == end || boundary_degree_[v] == 0 || (Regular(v) && vertex_mark_[v] == stamp_);
    };
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    std::vector<int> touched{start};
    vertex_distance_[start] = 0;
    queue.push({0, start});
    while (!queue.empty()) {
      const auto [d, v] = queue.top();
      queue.pop();
      if (d > vertex_distance_[v]) continue;
      if (v == end) break;
      for (const int* r = surface_.RingBegin(v); r != surface_.RingEnd(v); ++r) {
        const int h = *r, w = surface_.Vertex(Next(h));
        if (surface_.Opposite(h) < 0 || !Fuzzy(h / 3) || !Fuzzy(surface_.Neighbour(h)) || !free(w)) continue;
        const double nd = d + surface_.Length(h);
        if (nd >= vertex_distance_[w]) continue;
        if (vertex_distance_[w] == kFar) touched.push_back(w);
        vertex_distance_[w] = nd;
        vertex_from_[w] = h;
        queue.push({nd, w});
      }
    }
    std::vector<int> path;
    if (vertex_distance_[end] < kFar)
      for (int v = end; v != start; v = surface_.Vertex(path.back())) path.push_back(vertex_from_[v]);
    for (int v : touched) vertex_distance_[v] = kFar;
    if (path.empty()) return false;
    std::reverse(path.begin(), path.end());
    return Divide(s, path, ids, to_left, to_right);
  }

  // The path becomes the boundary: what lies to its left in the fuzzy area goes to the left chart, the rest
  // to the other. False when the path does not part the two.
  bool Divide(const Segment& s, const std::vector<int>& path, const ChartIds& ids, std::vector<int>& to_left,
              std::vector<int>& to_right) {
    for (int h : s.edges) on_path_[h] = on_path_[surface_.Opposite(h)] = -stamp_;
    for (int h : path) on_path_[h] = on_path_[surface_.Opposite(h)] = stamp_;
    auto passable = [&](int h) {
      const int g = surface_.Neighbour(h);
      if (g < 0 || !Fuzzy(g) || on_path_[h] == stamp_) return false;
      return ids[g] == ids[h / 3] ||
             on_path_[h] == -stamp_;  // the old segment is open, other boundaries are not
    };
    std::vector<int> stack;
    for (int side : {1, 2}) {
      const int mark = 4 * stamp_ + side, other = 4 * stamp_ + 3 - side;
      for (int h : path) stack.push_back(side == 1 ? h / 3 : surface_.Neighbour(h));
      while (!stack.empty()) {
        const int f = stack.back();
        stack.pop_back();
        if (side_[f] == other) return false;
        if (side_[f] == mark) continue;
        side_[f] = mark;
        if (side == 1 && ids[f] != s.left) to_left.push_back(f);
        if (side == 2 && ids[f] != s.right) to_right.push_back(f);
        for (int h = 3 * f; h < 3 * f + 3; ++h)
          if (passable(h)) stack.push_back(surface_.Neighbour(h));
      }
    }
    return true;
  }

  bool CutLoop(const Segment& s, const ChartIds& ids, std::vector<int>& to_left, std::vector<int>& to_right) {
    const std::vector<int>& faces = distance_.Reached();
    node_.resize(surface_.FaceCount());
    for (size_t k = 0; k < faces.size(); ++k) node_[faces[k]] = static_cast<int>(k);
    std::vector<FlowEdge> edges;
    std::array<std::vector<int>, 2> terminals;
    std::array<std::pair<double, int>, 2> deepest{{{-1, -1}, {-1, -1}}};
    for (size_t k = 0; k < faces.size(); ++k) {
      const int f = faces[k], n = static_cast<int>(k);
      const int side = ids[f] == s.left ? 0 : 1;
      bool at_rim = false;
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h);
        if (g < 0) continue;
        if (Fuzzy(g)) {
          if (g > f) edges.push_back({n, node_[g], surface_.Length(h) * Remoteness(f, g)});
        } else {
          at_rim = true;  // of the fuzzy area, or of the pair of charts: this face keeps its chart
        }
      }
      if (at_rim) terminals[side].push_back(n);
      if (distance_[f] > deepest[side].first) deepest[side] = {distance_[f], n};
    }
    for (int side : {0, 1}) {
      if (terminals[side].empty() && deepest[side].second >= 0)
        terminals[side].push_back(deepest[side].second);
      if (terminals[side].empty()) return false;
    }
    const std::vector<bool> left = MinCut(static_cast<int>(faces.size()), edges, terminals[0], terminals[1]);
    for (size_t k = 0; k < faces.size(); ++k) {
      if (left[k] && ids[faces[k]] != s.left) to_left.push_back(faces[k]);
      if (!left[k] && ids[faces[k]] != s.right) to_right.push_back(faces[k]);
    }
    return true;
  }

  // A loop gets shorter merely by shrinking; edges far from the old one cost more, so that it straightens but
  // stays.
  double Remoteness(int f, int g) const { return 1 + 0.5 * (distance_[f] + distance_[g]) / depth_; }

  double BoundaryAround(const std::vector<int>& a, const std::vector<int>& b, const ChartIds& ids) {
    double length = 0;
    ++count_stamp_;
    for (const auto* faces : {&a, &b})
      for (int f : *faces)
        for (int h = 3 * f; h < 3 * f + 3; ++h) {
          const int o = surface_.Opposite(h);
          if (o < 0 || ids[o / 3] == ids[f] || counted_[o] == count_stamp_) continue;
          counted_[h] = count_stamp_;
          length += surface_.Length(h);
        }
    return length;
  }

  // Takes the change back when the boundary gets no shorter or a chart would fall apart.
  void Apply(const Segment& s, const std::vector<int>& to_left, const std::vector<int>& to_right,
             ChartIds& ids) {
    counted_.resize(surface_.HalfEdgeCount(), 0);
    const double before = BoundaryAround(to_left, to_right, ids);
    for (int f : to_left) ids[f] = s.left;
    for (int f : to_right) ids[f] = s.right;
    const double after = BoundaryAround(to_left, to_right, ids);
    chart_faces_[s.left].insert(chart_faces_[s.left].end(), to_left.begin(), to_left.end());
    chart_faces_[s.right].insert(chart_faces_[s.right].end(), to_right.begin(), to_right.end());
    const bool good = after < before * (1 - 1e-9) && Connected(s.left, ids) && Connected(s.right, ids);
    if (!good) {
      for (int f : to_left) ids[f] = s.right;
      for (int f : to_right) ids[f] = s.left;
    }
    // Boundary degrees of the vertices around the change follow.
    if (good) UpdateDegrees(s, to_left, to_right, ids);
  }

  void UpdateDegrees(const Segment& s, const std::vector<int>& to_left, const std::vector<int>& to_right,
                     const ChartIds& ids) {
    ++count_stamp_;
    vertex_counted_.resize(surface_.VertexCount(), 0);
    auto recount = [&](int v) {
      if (vertex_counted_[v] == count_stamp_ || boundary_degree_[v] >= 1000) return;
      vertex_counted_[v] = count_stamp_;
      int degree = 0;
      for (const int* r = surface_.RingBegin(v); r != surface_.RingEnd(v); ++r)
        degree += ids[surface_.Neighbour(*r)] != ids[*r / 3];
      boundary_degree_[v] = degree;
    };
    for (const auto* faces : {&to_left, &to_right})
      for (int f : *faces)
        for (int i = 0; i < 3; ++i) recount(surface_.Vertex(3 * f + i));
    for (int h : s.edges) recount(surface_.Vertex(h));
  }

  // True when the chart is one piece. Drops from its list the faces that have left it.
  bool Connected(int chart, const ChartIds& ids) {
    auto& faces = chart_faces_[chart];
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    std::vector<int> mine;
    for (int f : faces)
      if (ids[f] == chart) mine.push_back(f);
    return topology_.IsConnected(chart, mine, static_cast<int>(mine.size()), ids);
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
  DualDistance<MeshType> distance_;
  ChartTopology<MeshType> topology_;
  std::vector<std::vector<int>> chart_faces_;  // may hold faces that have left the chart
  std::vector<ConeProxy> proxy_;
  double depth_ = 0;  // of the present fuzzy area
  std::vector<double> chart_area_;
  std::vector<int> boundary_degree_;
  std::vector<int> fuzzy_, side_, on_path_;  // valid where they hold the current stamp
  std::vector<int> node_;                    // of a face in the flow network
  std::vector<double> vertex_distance_;
  std::vector<int> vertex_from_, vertex_mark_;
  std::vector<int> counted_, vertex_counted_;
  int stamp_ = 0, count_stamp_ = 0;
};

}  // namespace dcharts
