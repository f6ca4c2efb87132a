// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/simplify_seams.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "pattern/point_grid.h"
#include "pattern/segments.h"

namespace dcharts {
namespace {

class Simplifier {
 public:
  Simplifier(const FlatCharts& charts, const SeamGraph& graph, const SimplifyOptions& options)
      : charts_(charts), graph_(graph), options_(options) {
    for (const FlatChart& chart : charts.charts) {
      corners_.emplace_back(chart.uv.rows(), 0);
      grids_.emplace_back(chart.uv);
    }
    for (const FineSeam& seam : graph.seams) {
      const int count = seam.VertexCount();
      Chain chain;
      chain.kept.assign(count, 1);
      chain.cost.assign(count, 0);
      chain.version.assign(count, 0);
      for (int k = 0; k < count; ++k) {
        chain.before.push_back(k - 1);
        chain.after.push_back(k + 1 < count ? k + 1 : -1);
      }
      chain.left = count;
      chains_.push_back(std::move(chain));
      for (const FineSide& side : seam.sides)
        for (int v : side.vertices)
          if (!corners_[side.chart][v]) {
            corners_[side.chart][v] = 1;
            grids_[side.chart].Add(v);
          }
    }
    FindLoops();
  }

  KeptVertices Run(const std::function<void()>& poll) {
    for (int s = 0; s < static_cast<int>(chains_.size()); ++s)
      for (int k = 1; k + 1 < graph_.seams[s].VertexCount(); ++k) Push(s, k);
    size_t steps = 0;
    while (!queue_.empty()) {
      if (poll && ++steps % 1024 == 0) poll();
      const Item item = queue_.top();
      queue_.pop();
      Chain& chain = chains_[item.seam];
      if (!chain.kept[item.vertex] || chain.version[item.vertex] != item.version) continue;
      if (!MayGo(item.seam, item.vertex)) continue;  // looked at again when a neighbour goes
      Collapse(item);
    }
    KeptVertices kept;
    for (Chain& chain : chains_) kept.push_back(std::move(chain.kept));
    return kept;
  }

 private:
  struct Chain {
    std::vector<char> kept;
    std::vector<int> before, after, version;
    std::vector<double> cost;  // added by neighbours that went
    int left = 0;
  };
  struct Item {
    double cost;
    int seam, vertex, version;
    bool operator<(const Item& o) const {  // the queue's top is the largest: the cheapest
      if (cost != o.cost) return cost > o.cost;
      return std::make_pair(seam, vertex) > std::make_pair(o.seam, o.vertex);
    }
  };

  Point2 At(const FineSide& side, int k) const {
    return charts_.charts[side.chart].uv.row(side.vertices[k]).transpose();
  }

  // How many corners each outline has left.
  void FindLoops() {
    for (size_t c = 0; c < charts_.charts.size(); ++c) {
      const FlatChart& chart = charts_.charts[c];
      const auto& places = graph_.places[c];
      std::vector<char> is_boundary(places.size());
      for (size_t h = 0; h < places.size(); ++h) is_boundary[h] = places[h].seam >= 0;
      const ChartBoundary boundary = BoundaryOf(chart, is_boundary);
      loop_of_.emplace_back(chart.uv.rows(), -1);
      for (int v = 0; v < static_cast<int>(chart.uv.rows()); ++v) {
        if (boundary.leaving[v] < 0 || loop_of_[c][v] >= 0) continue;
        int corners = 0;
        for (int w = v; loop_of_[c][w] < 0; w = EndOf(chart, boundary.leaving[w]), ++corners)
          loop_of_[c][w] = static_cast<int>(corners_left_.size());
        corners_left_.push_back(corners);
      }
    }
  }

  double CostOf(int s, int k) const {
    const Chain& chain = chains_[s];
    double cost = chain.cost[k];
    for (const FineSide& side : graph_.seams[s].sides)
      cost += std::abs(Orient(At(side, chain.before[k]), At(side, k), At(side, chain.after[k]))) / 2;
    return cost;
  }

  void Push(int s, int k) {
    Chain& chain = chains_[s];
    if (chain.before[k] < 0 || chain.after[k] < 0) return;  // an end of the seam
    queue_.push({CostOf(s, k), s, k, ++chain.version[k]});
  }

  bool MayGo(int s, int k) const {
    constexpr int kFewest = 3;
    const FineSeam& seam = graph_.seams[s];
    const Chain& chain = chains_[s];
    if (seam.closed && chain.left - 1 <= kFewest) return false;  // one vertex is there twice
    const int a = chain.before[k], b = chain.after[k];
    double shortest = 0, longest = 0;
    for (size_t j = 0; j < seam.sides.size(); ++j) {
      const FineSide& side = seam.sides[j];
      // A piece's outline may lose several corners at once: one per side of the seam that it has.
      int lost = 0;
      const int loop = loop_of_[side.chart][side.vertices[k]];
      for (const FineSide& other : seam.sides)
        lost += other.chart == side.chart && loop_of_[other.chart][other.vertices[k]] == loop;
      if (corners_left_[loop] - lost < kFewest) return false;
      const Point2 p = At(side, a), q = At(side, b);
      for (int i = a + 1; i < b; ++i)
        if (DistanceToSegment(At(side, i), p, q) > options_.tolerance) return false;
      const double length = (p - q).norm();
      if (!(length > 0)) return false;
      shortest = j == 0 ? length : std::min(shortest, length);
      longest = std::max(longest, length);
      if (!TriangleIsFree(side, a, k, b)) return false;
    }
    return longest - shortest <= options_.most_ease * (seam.arc[b] - seam.arc[a]);
  }

  // No other corner of the piece lies in the triangle, so the new edge crosses nothing.
  bool TriangleIsFree(const FineSide& side, int a, int k, int b) const {
    Point2 t[3] = {At(side, a), At(side, k), At(side, b)};
    double twice_area = Orient(t[0], t[1], t[2]);
    if (twice_area < 0) {
      std::swap(t[0], t[2]);
      twice_area = -twice_area;
    }
    // On a straight line nothing changes.
    constexpr double kStraight = 1e-9;
    if (twice_area <= kStraight * (t[0] - t[2]).squaredNorm()) return true;
    const int corners[3] = {side.vertices[a], side.vertices[k], side.vertices[b]};
    return !grids_[side.chart].AnyInTriangle(t, corners);
  }

  void Collapse(const Item& item) {
    Chain& chain = chains_[item.seam];
    const int k = item.vertex, a = chain.before[k], b = chain.after[k];
    chain.kept[k] = 0;
    --chain.left;
    chain.after[a] = b;
    chain.before[b] = a;
    for (const FineSide& side : graph_.seams[item.seam].sides) {
      const int v = side.vertices[k];
      if (!corners_[side.chart][v]) continue;
      corners_[side.chart][v] = 0;
      grids_[side.chart].Remove(v);
      --corners_left_[loop_of_[side.chart][v]];
    }
    for (int neighbour : {a, b}) {
      chain.cost[neighbour] += item.cost / 2;
      Push(item.seam, neighbour);
    }
  }

  const FlatCharts& charts_;
  const SeamGraph& graph_;
  const SimplifyOptions& options_;
  std::vector<Chain> chains_;
  std::vector<std::vector<char>> corners_;  // per chart, per vertex: it is a corner of the outline
  std::vector<PointGrid> grids_;            // per chart: its corners
  std::vector<std::vector<int>> loop_of_;   // per chart, per vertex: index into corners_left_
  std::vector<int> corners_left_;
  std::priority_queue<Item> queue_;
};

}  // namespace

KeptVertices SimplifySeams(const FlatCharts& charts, const SeamGraph& graph, const SimplifyOptions& options,
                           const std::function<void()>& poll) {
  return Simplifier(charts, graph, options).Run(poll);
}

}  // namespace dcharts
