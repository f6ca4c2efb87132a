// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/folds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "common/pi.h"
#include "common/union_find.h"
#include "pattern/half_edges.h"
#include "pattern/outline.h"
#include "pattern/segments.h"
#include "planar/polygon.h"

namespace dcharts {
namespace {

Eigen::Vector3d NormalOf(const FlatChart& chart, Eigen::Index t) {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return chart.mesh.positions.row(chart.mesh.triangles(t, k));
  };
  const Eigen::Vector3d n = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  const double length = n.norm();
  return length > 0 ? Eigen::Vector3d(n / length) : Eigen::Vector3d::Zero();
}

/// A fold edge of the chart.
struct FoldEdge {
  int a = 0, b = 0;    // vertices
  double degrees = 0;  // positive: a mountain
  bool taken = false;
};

std::vector<FoldEdge> FoldEdgesOf(const FlatChart& chart, double least_degrees) {
  const std::map<std::pair<int, int>, int> half_edges = HalfEdges(chart);
  std::vector<FoldEdge> edges;
  for (const auto& [edge, h] : half_edges) {
    const auto across = half_edges.find({edge.second, edge.first});
    if (edge.first > edge.second || across == half_edges.end()) continue;
    const Eigen::Vector3d m = NormalOf(chart, h / 3), n = NormalOf(chart, across->second / 3);
    if (m.isZero() || n.isZero()) continue;
    const Eigen::Vector3d along =
        (chart.mesh.positions.row(edge.second) - chart.mesh.positions.row(edge.first)).transpose();
    const double degrees = std::atan2(m.cross(n).dot(along.normalized()), m.dot(n)) * 180 / kPi;
    if (std::abs(degrees) >= least_degrees && degrees != 0)
      edges.push_back({edge.first, edge.second, degrees, false});
  }
  return edges;
}

// A crease in paper does not end within it: edges that do, and specks of creases, are where a curved part
// bends most. Those of a sharp bend stay, wherever they are.
void DropLooseEdges(const FlatChart& chart, double least_degrees, std::vector<FoldEdge>& edges) {
  constexpr double kSharp = 2, kSpeck = 12;  // of the least angle; mm
  std::vector<char> at_outline(chart.uv.rows(), 0);
  const std::vector<int> opposite = OppositeHalfEdges(chart);
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h)
    if (opposite[h] < 0) at_outline[StartOf(chart, h)] = at_outline[EndOf(chart, h)] = 1;
  UnionFind joined(static_cast<int>(chart.uv.rows()));
  for (const FoldEdge& edge : edges) joined.Join(edge.a, edge.b);
  struct Crease {
    double length = 0, sharpest = 0;
    bool reaches_outline = false;
  };
  std::map<int, Crease> creases;
  for (const FoldEdge& edge : edges) {
    Crease& crease = creases[joined.Find(edge.a)];
    crease.length += (chart.uv.row(edge.a) - chart.uv.row(edge.b)).norm();
    crease.sharpest = std::max(crease.sharpest, std::abs(edge.degrees));
    crease.reaches_outline |= at_outline[edge.a] != 0 || at_outline[edge.b] != 0;
  }
  const auto is_loose = [&](const FoldEdge& edge) {
    const Crease& crease = creases[joined.Find(edge.a)];
    return crease.sharpest < kSharp * least_degrees && (!crease.reaches_outline || crease.length < kSpeck);
  };
  edges.erase(std::remove_if(edges.begin(), edges.end(), is_loose), edges.end());
}

}  // namespace

std::vector<std::pair<Point2, Point2>> ClipToRegion(const Point2& a, const Point2& b,
                                                    const std::vector<Polyline>& loops) {
  std::vector<double> cuts{0, 1};
  const Point2 d = b - a;
  for (const Polyline& loop : loops)
    for (size_t k = 0; k < loop.size(); ++k) {
      const Point2 &p = loop[k], &q = loop[(k + 1) % loop.size()], e = q - p;
      const double det = d.x() * e.y() - d.y() * e.x();
      if (det == 0) continue;
      const Point2 w = p - a;
      const double t = (w.x() * e.y() - w.y() * e.x()) / det, s = (w.x() * d.y() - w.y() * d.x()) / det;
      if (t > 0 && t < 1 && s >= 0 && s <= 1) cuts.push_back(t);
    }
  std::sort(cuts.begin(), cuts.end());
  std::vector<std::pair<Point2, Point2>> parts;
  for (size_t k = 0; k + 1 < cuts.size(); ++k) {
    if (!(cuts[k + 1] > cuts[k]) || !IsInside(loops, a + (cuts[k] + cuts[k + 1]) / 2 * d)) continue;
    const Point2 from = a + cuts[k] * d, to = a + cuts[k + 1] * d;
    if (!parts.empty() && parts.back().second == from)
      parts.back().second = to;
    else
      parts.push_back({from, to});
  }
  return parts;
}

void AddFolds(const FlatChart& chart, double least_degrees, Piece& piece) {
  std::vector<FoldEdge> edges = FoldEdgesOf(chart, least_degrees);
  DropLooseEdges(chart, least_degrees, edges);
  std::multimap<int, size_t> at_vertex;
  for (size_t e = 0; e < edges.size(); ++e) {
    at_vertex.insert({edges[e].a, e});
    at_vertex.insert({edges[e].b, e});
  }
  const std::vector<Polyline> outline = OutlineOf(piece);
  const auto at = [&](int v) -> Point2 { return chart.uv.row(v).transpose(); };
  for (size_t first = 0; first < edges.size(); ++first) {
    if (edges[first].taken) continue;
    edges[first].taken = true;
    std::vector<int> line{edges[first].a, edges[first].b};
    double degrees = edges[first].degrees * (at(line[0]) - at(line[1])).norm();
    double length = (at(line[0]) - at(line[1])).norm();
    // On from either end, as straight as there is a way.
    for (const bool forward : {true, false}) {
      for (;;) {
        const int end = forward ? line.back() : line.front();
        const int before = forward ? line[line.size() - 2] : line[1];
        const Point2 direction = (at(end) - at(before)).normalized();
        constexpr double kStraightOn = 0.94;  // cosine of 20 degrees
        double best = kStraightOn;
        size_t next = edges.size();
        const auto range = at_vertex.equal_range(end);
        for (auto it = range.first; it != range.second; ++it) {
          const FoldEdge& edge = edges[it->second];
          if (edge.taken || (edge.degrees > 0) != (edges[first].degrees > 0)) continue;
          const int other = edge.a == end ? edge.b : edge.a;
          const double cosine = (at(other) - at(end)).normalized().dot(direction);
          if (cosine <= best) continue;
          best = cosine;
          next = it->second;
        }
        if (next == edges.size()) break;
        edges[next].taken = true;
        const int other = edges[next].a == end ? edges[next].b : edges[next].a;
        const double step = (at(other) - at(end)).norm();
        degrees += edges[next].degrees * step;
        length += step;
        line.insert(forward ? line.end() : line.begin(), other);
      }
    }
    if (!(length > 0)) continue;
    // Clipped edge by edge, then joined again; corners on a straight line are left out.
    Fold fold;
    fold.mountain = degrees > 0;
    fold.angle_degrees = std::abs(degrees) / length;
    const auto finish = [&] {
      if (fold.line.size() >= 2) piece.folds.push_back(fold);
      fold.line.clear();
    };
    for (size_t k = 0; k + 1 < line.size(); ++k) {
      const auto parts = ClipToRegion(at(line[k]), at(line[k + 1]), outline);
      if (parts.empty()) finish();
      for (const auto& [from, to] : parts) {
        if (!fold.line.empty() && fold.line.back() != from) finish();
        if (fold.line.empty()) fold.line.push_back(from);
        constexpr double kOnLine = 0.02;  // mm
        const size_t n = fold.line.size();
        if (n >= 2 && DistanceToSegment(fold.line[n - 1], fold.line[n - 2], to) < kOnLine)
          fold.line.back() = to;
        else
          fold.line.push_back(to);
      }
    }
    finish();
  }
}

}  // namespace dcharts
