// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/chart_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/union_find.h"
#include "pattern/faces_around.h"
#include "pattern/flip_edges.h"
#include "pattern/half_edges.h"

namespace dcharts {
namespace {

// A boundary edge by its vertices: these keep their numbers while triangles are parted.
struct NamedEdge {
  int chart = 0, start = 0, end = 0;
  int half_edge = 0;  // as long as no triangle of the chart was parted
};

int AddBetween(int a, int b, double share, int model_vertex, FlatChart& chart) {
  const auto v = chart.uv.rows();
  chart.uv.conservativeResize(v + 1, Eigen::NoChange);
  chart.mesh.positions.conservativeResize(v + 1, Eigen::NoChange);
  chart.uv.row(v) = (1 - share) * chart.uv.row(a) + share * chart.uv.row(b);
  chart.mesh.positions.row(v) =
      (1 - share) * chart.mesh.positions.row(a) + share * chart.mesh.positions.row(b);
  chart.model_vertex.push_back(model_vertex);
  return static_cast<int>(v);
}

// The half-edge from a vertex to another; -1: there is none.
int Find(const FlatChart& chart, int start, int end) {
  for (int h = 0; h < 3 * static_cast<int>(chart.mesh.triangles.rows()); ++h)
    if (StartOf(chart, h) == start && EndOf(chart, h) == end) return h;
  return -1;
}

// Makes two triangles of the one of a half-edge, with a vertex on it.
void PartTriangle(int half_edge, int vertex, FlatChart& chart) {
  Triangles& triangles = chart.mesh.triangles;
  const int f = half_edge / 3, g = static_cast<int>(triangles.rows());
  triangles.conservativeResize(g + 1, Eigen::NoChange);
  triangles.row(g) = triangles.row(f);
  triangles(g, half_edge % 3) = vertex;
  triangles(f, (half_edge + 1) % 3) = vertex;
  chart.source_face.push_back(chart.source_face[f]);
}

class Cutter {
 public:
  Cutter(const PlaneLine& line, int chart, FlatCharts& charts)
      : line_(line),
        c_(chart),
        charts_(charts),
        chart_(charts.charts[chart]),
        faces_(chart_),
        is_parted_(charts.charts.size(), 0) {
    for (int v = 0; v < static_cast<int>(chart_.uv.rows()); ++v) side_.push_back(SideOf(v));
    for (const auto& edge : charts.edges) {
      edges_.emplace_back();
      for (const ChartEdge& side : edge) edges_.back().push_back(Named(side));
    }
    for (const FlatChart& other : charts.charts)
      for (int v : other.model_vertex) next_model_vertex_ = std::max(next_model_vertex_, v + 1);
  }

  int Run(const BoundaryCrossing& from, const BoundaryCrossing& to) {
    const NamedEdge first_edge = Named({c_, from.half_edge}), last_edge = Named({c_, to.half_edge});
    const int first = PartBoundary(first_edge, from.share);
    const int last = faces_.HalfEdge(last_edge.start, last_edge.end) >= 0 ? PartBoundary(last_edge, to.share)
                                                                          : PartAgain(last_edge);
    PartInside(first, last);
    FlipEdges(cut_, chart_);
    return TakeApart();
  }

 private:
  int SideOf(int v) const { return line_.Off(chart_.uv.row(v).transpose()) >= 0 ? 1 : -1; }

  NamedEdge Named(const ChartEdge& edge) const {
    const FlatChart& chart = charts_.charts[edge.chart];
    return {edge.chart, StartOf(chart, edge.half_edge), EndOf(chart, edge.half_edge), edge.half_edge};
  }

  // Of the chart, which has it already.
  void AddVertex(int side) {
    side_.push_back(side);
    faces_.AddVertex();
  }

  void Part(int half_edge, int vertex) {
    PartTriangle(half_edge, vertex, chart_);
    faces_.AddParted(half_edge / 3, vertex);
  }

  // Parts a boundary edge of the chart on all the edge's sides; returns the chart's new vertex.
  int PartBoundary(const NamedEdge& edge, double share) {
    size_t e = 0, own = 0;
    for (size_t i = 0; i < edges_.size(); ++i)
      for (size_t k = 0; k < edges_[i].size(); ++k)
        if (edges_[i][k].chart == c_ && edges_[i][k].start == edge.start && edges_[i][k].end == edge.end) {
          e = i;
          own = k;
        }
    const auto start_of = [&](const NamedEdge& side) {
      return charts_.charts[side.chart].model_vertex[side.start];
    };
    const int start = start_of(edges_[e][own]);
    std::vector<NamedEdge> second = edges_[e];
    int vertex = -1;
    for (size_t k = 0; k < second.size(); ++k) {
      const NamedEdge side = edges_[e][k];
      FlatChart& chart = charts_.charts[side.chart];
      const bool same_way = k == own || start_of(side) == start;
      const int m = AddBetween(side.start, side.end, same_way ? share : 1 - share, next_model_vertex_, chart);
      if (k == own) vertex = m;
      is_parted_[side.chart] = 1;
      if (side.chart == c_) {
        AddVertex(k == own ? 0 : SideOf(m));
        Part(faces_.HalfEdge(side.start, side.end), m);
      } else {
        PartTriangle(Find(chart, side.start, side.end), m, chart);
      }
      edges_[e][k].end = m;
      second[k].start = m;
      if (!same_way) std::swap(edges_[e][k], second[k]);
    }
    ++next_model_vertex_;
    edges_.push_back(std::move(second));
    return vertex;
  }

  // The same for an edge that has a vertex already, as its other side was parted: that is taken if it is near
  // enough to the line.
  int PartAgain(const NamedEdge& edge) {
    constexpr double kNear = 1;                      // mm
    int v = static_cast<int>(chart_.uv.rows()) - 1;  // the sides' vertices came last
    while (faces_.HalfEdge(edge.start, v) < 0 || faces_.HalfEdge(v, edge.end) < 0) --v;
    if (std::abs(line_.Off(chart_.uv.row(v).transpose())) < kNear) {
      side_[v] = 0;
      return v;
    }
    const NamedEdge part =
        side_[v] == side_[edge.start] ? NamedEdge{c_, v, edge.end, -1} : NamedEdge{c_, edge.start, v, -1};
    return PartBoundary(part, ShareAt(faces_.HalfEdge(part.start, part.end)));
  }

  // From a vertex on the line, the half-edge of a triangle there that the line crosses next; -1: none.
  int NextCrossed(int vertex) const {
    int nearest = -1;
    double least = 0;
    for (const int f : faces_.Around(vertex))
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        if (chart_.mesh.triangles(f, (h + 2) % 3) != vertex) continue;
        if (side_[StartOf(chart_, h)] * side_[EndOf(chart_, h)] >= 0) continue;
        const double along = line_.direction.dot(Crossing(h) - Point2(chart_.uv.row(vertex).transpose()));
        if (nearest < 0 || along < least || (along == least && h < nearest)) {
          nearest = h;
          least = along;
        }
      }
    return nearest;
  }

  double ShareAt(int h) const {
    const double a = line_.Off(chart_.uv.row(StartOf(chart_, h)).transpose()),
                 b = line_.Off(chart_.uv.row(EndOf(chart_, h)).transpose());
    return a == b ? 0.5 : a / (a - b);
  }

  Point2 Crossing(int h) const {
    const double share = ShareAt(h);
    return ((1 - share) * chart_.uv.row(StartOf(chart_, h)) + share * chart_.uv.row(EndOf(chart_, h)))
        .transpose();
  }

  bool AreNeighbours(int v, int w) const { return faces_.HalfEdge(v, w) >= 0 && faces_.HalfEdge(w, v) >= 0; }

  // Parts the triangles along the line; the edges between the new vertices are the cut.
  void PartInside(int first, int last) {
    int vertex = first;
    while (!AreNeighbours(vertex, last)) {
      const int h = NextCrossed(vertex);
      if (h < 0) break;
      const int start = StartOf(chart_, h), end = EndOf(chart_, h);
      const int across = faces_.HalfEdge(end, start);
      if (across < 0) break;
      const double share = ShareAt(h);
      const int m = AddBetween(start, end, share, next_model_vertex_++, chart_);
      AddVertex(0);
      Part(h, m);
      Part(across, m);
      cut_.push_back({vertex, m});
      vertex = m;
    }
    if (AreNeighbours(vertex, last))
      cut_.push_back({vertex, last});
    else
      cut_.clear();  // rounding led astray: nothing comes apart
  }

  int TakeApart() {
    const auto half_edges = HalfEdges(chart_);
    std::vector<std::array<int, 2>> cut_sides;
    for (const auto& [a, b] : cut_) cut_sides.push_back({half_edges.at({a, b}), half_edges.at({b, a})});
    FindParts(cut_sides);
    std::vector<FlatChart> parts = MakeParts();
    const int more = static_cast<int>(charts_.charts.size());
    const auto place = [&](int h) -> ChartEdge {
      const int p = part_of_[h / 3];
      return {p == 0 ? c_ : more + p - 1, 3 * face_in_part_[h / 3] + h % 3};
    };
    std::vector<std::map<std::pair<int, int>, int>> others(charts_.charts.size());
    charts_.edges.clear();
    for (const auto& edge : edges_) {
      charts_.edges.emplace_back();
      for (const NamedEdge& side : edge) {
        if (side.chart == c_) {
          charts_.edges.back().push_back(place(half_edges.at({side.start, side.end})));
          continue;
        }
        if (!is_parted_[side.chart]) {
          charts_.edges.back().push_back({side.chart, side.half_edge});
          continue;
        }
        if (others[side.chart].empty()) others[side.chart] = HalfEdges(charts_.charts[side.chart]);
        charts_.edges.back().push_back({side.chart, others[side.chart].at({side.start, side.end})});
      }
    }
    for (const auto& [h, g] : cut_sides) charts_.edges.push_back({place(h), place(g)});
    chart_ = std::move(parts[0]);
    for (size_t p = 1; p < parts.size(); ++p) charts_.charts.push_back(std::move(parts[p]));
    return static_cast<int>(parts.size());
  }

  // What is still joined: faces across edges, and corners of faces around vertices.
  void FindParts(const std::vector<std::array<int, 2>>& cut_sides) {
    std::vector<int> opposite = OppositeHalfEdges(chart_);
    for (const auto& [h, g] : cut_sides) opposite[h] = opposite[g] = -1;
    corners_ = UnionFind(static_cast<int>(opposite.size()));
    part_of_.assign(opposite.size() / 3, -1);
    face_in_part_ = part_of_;
    for (int f = 0; f < static_cast<int>(part_of_.size()); ++f) {
      if (part_of_[f] >= 0) continue;
      const int part = static_cast<int>(faces_of_.size());
      faces_of_.push_back(0);
      std::vector<int> stack = {f};
      part_of_[f] = part;
      while (!stack.empty()) {
        const int g = stack.back();
        stack.pop_back();
        face_in_part_[g] = faces_of_[part]++;
        for (int h = 3 * g; h < 3 * g + 3; ++h) {
          const int o = opposite[h];
          if (o < 0) continue;
          corners_.Join(h, 3 * (o / 3) + (o + 1) % 3);
          if (part_of_[o / 3] >= 0) continue;
          part_of_[o / 3] = part;
          stack.push_back(o / 3);
        }
      }
    }
  }

  std::vector<FlatChart> MakeParts() {
    const int face_count = static_cast<int>(part_of_.size());
    std::vector<int> vertex_of(3 * part_of_.size(), -1);
    std::vector<std::vector<int>> vertices(faces_of_.size());  // per part, per vertex: the one it was
    for (int k = 0; k < 3 * face_count; ++k) {
      int& v = vertex_of[corners_.Find(k)];
      if (v >= 0) continue;
      v = static_cast<int>(vertices[part_of_[k / 3]].size());
      vertices[part_of_[k / 3]].push_back(chart_.mesh.triangles(k / 3, k % 3));
    }
    std::vector<FlatChart> parts(faces_of_.size());
    for (size_t p = 0; p < parts.size(); ++p) {
      parts[p].mesh.triangles.resize(faces_of_[p], 3);
      parts[p].source_face.resize(faces_of_[p]);
      parts[p].uv.resize(static_cast<Eigen::Index>(vertices[p].size()), 2);
      parts[p].mesh.positions.resize(static_cast<Eigen::Index>(vertices[p].size()), 3);
      for (size_t v = 0; v < vertices[p].size(); ++v) {
        const auto row = static_cast<Eigen::Index>(v);
        parts[p].uv.row(row) = chart_.uv.row(vertices[p][v]);
        parts[p].mesh.positions.row(row) = chart_.mesh.positions.row(vertices[p][v]);
        parts[p].model_vertex.push_back(chart_.model_vertex[vertices[p][v]]);
      }
    }
    for (int f = 0; f < face_count; ++f) {
      FlatChart& part = parts[part_of_[f]];
      part.source_face[face_in_part_[f]] = chart_.source_face[f];
      for (int k = 0; k < 3; ++k)
        part.mesh.triangles(face_in_part_[f], k) = vertex_of[corners_.Find(3 * f + k)];
    }
    return parts;
  }

  const PlaneLine& line_;
  int c_;
  FlatCharts& charts_;
  FlatChart& chart_;
  FacesAround faces_;            // of the chart
  std::vector<char> is_parted_;  // per chart: half-edges have other numbers now
  std::vector<int> side_;        // per vertex of the chart: of the line; 0 on the cut
  std::vector<std::vector<NamedEdge>> edges_;
  std::vector<std::pair<int, int>> cut_;
  UnionFind corners_{0};
  std::vector<int> part_of_, face_in_part_;  // per face
  std::vector<int> faces_of_;                // per part
  int next_model_vertex_ = 0;
};

}  // namespace

int LeavesAt(const FlatChart& chart, const std::vector<int>& opposite, const PlaneLine& line, int half_edge) {
  const auto is_left = [&](int v) { return line.Off(chart.uv.row(v).transpose()) >= 0; };
  int h = half_edge;
  for (size_t steps = 0; steps <= opposite.size(); ++steps) {
    // Of the triangle's other edges, the one with ends on both sides.
    const int next = 3 * (h / 3) + (h + 1) % 3, last = 3 * (h / 3) + (h + 2) % 3;
    h = is_left(StartOf(chart, next)) != is_left(EndOf(chart, next)) ? next : last;
    if (opposite[h] < 0) return h;
    h = opposite[h];
  }
  return -1;
}

std::vector<BoundaryCrossing> CrossingsOf(const FlatChart& chart, const std::vector<int>& boundary,
                                          const PlaneLine& line) {
  std::vector<BoundaryCrossing> crossings;
  for (int h : boundary) {
    const Point2 a = chart.uv.row(StartOf(chart, h)).transpose(),
                 b = chart.uv.row(EndOf(chart, h)).transpose();
    const double from = line.Off(a), to = line.Off(b);
    if ((from >= 0) == (to >= 0)) continue;
    const double share = from / (from - to);
    crossings.push_back({line.direction.dot(a + share * (b - a) - line.at), h, share, from < 0});
  }
  std::sort(crossings.begin(), crossings.end(), [](const BoundaryCrossing& a, const BoundaryCrossing& b) {
    return std::make_pair(a.along, a.half_edge) < std::make_pair(b.along, b.half_edge);
  });
  return crossings;
}

int CutAlong(const PlaneLine& line, const BoundaryCrossing& from, const BoundaryCrossing& to, int chart,
             FlatCharts& charts) {
  return Cutter(line, chart, charts).Run(from, to);
}

}  // namespace dcharts
