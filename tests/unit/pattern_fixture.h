// SPDX-License-Identifier: GPL-3.0-or-later
/// What the tests of patterns have in common: charts made by hand.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "common/surface_data.h"
#include "pattern/build_pieces.h"
#include "pattern/flat_charts.h"
#include "pattern/outline.h"
#include "pattern/pattern.h"
#include "pattern/seam_graph.h"
#include "pattern/segments.h"
#include "pattern/simplify_seams.h"
#include "planar/polygon.h"

namespace dcharts::test {

/// Charts of a manifold mesh: `id_at` paints faces (by centroid), `flat` lays a vertex flat.
inline FlatCharts ChartsOf(const SurfaceData& mesh, const std::function<int(const Point3&)>& id_at,
                           const std::function<Point2(const Point3&)>& flat) {
  const auto position = [&](int v) -> Point3 {
    return {mesh.vertices[v][0], mesh.vertices[v][1], mesh.vertices[v][2]};
  };
  FlatCharts result;
  std::vector<std::vector<std::array<int, 3>>> triangles;
  std::vector<std::map<int, int>> local;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    const auto id =
        static_cast<size_t>(id_at((position(face[0]) + position(face[1]) + position(face[2])) / 3));
    if (id >= result.charts.size()) {
      result.charts.resize(id + 1);
      triangles.resize(id + 1);
      local.resize(id + 1);
    }
    FlatChart& chart = result.charts[id];
    std::array<int, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      const auto [it, is_new] = local[id].insert({face[k], static_cast<int>(chart.model_vertex.size())});
      if (is_new) chart.model_vertex.push_back(face[k]);
      corners[k] = it->second;
    }
    triangles[id].push_back(corners);
    chart.source_face.push_back(static_cast<int>(f));
  }
  std::map<std::pair<int, int>, ChartEdge> directed;
  for (size_t c = 0; c < result.charts.size(); ++c) {
    FlatChart& chart = result.charts[c];
    chart.mesh.triangles.resize(static_cast<Eigen::Index>(triangles[c].size()), 3);
    chart.mesh.positions.resize(static_cast<Eigen::Index>(chart.model_vertex.size()), 3);
    chart.uv.resize(chart.mesh.positions.rows(), 2);
    for (size_t v = 0; v < chart.model_vertex.size(); ++v) {
      chart.mesh.positions.row(static_cast<Eigen::Index>(v)) = position(chart.model_vertex[v]).transpose();
      chart.uv.row(static_cast<Eigen::Index>(v)) = flat(position(chart.model_vertex[v])).transpose();
    }
    for (size_t t = 0; t < triangles[c].size(); ++t)
      for (int k = 0; k < 3; ++k) {
        chart.mesh.triangles(static_cast<Eigen::Index>(t), k) = triangles[c][t][k];
        directed[{chart.model_vertex[triangles[c][t][k]], chart.model_vertex[triangles[c][t][(k + 1) % 3]]}] =
            {static_cast<int>(c), static_cast<int>(3 * t) + k};
      }
  }
  for (const auto& [edge, side] : directed) {
    const auto across = directed.find({edge.second, edge.first});
    if (across == directed.end())
      result.edges.push_back({side});
    else if (across->second.chart != side.chart && edge.first < edge.second)
      result.edges.push_back({side, across->second});
  }
  return result;
}

inline Point2 FromAbove(const Point3& p) { return p.head<2>(); }

/// The boundary half-edges of a chart, sorted.
inline std::vector<int> BoundaryEdgesOf(const FlatCharts& charts, int chart) {
  std::vector<int> boundary;
  for (const auto& edge : charts.edges)
    for (const ChartEdge& side : edge)
      if (side.chart == chart) boundary.push_back(side.half_edge);
  std::sort(boundary.begin(), boundary.end());
  return boundary;
}

/// Every vertex stays.
inline KeptVertices AllVertices(const SeamGraph& graph) {
  KeptVertices kept;
  for (const FineSeam& seam : graph.seams) kept.emplace_back(seam.arc.size(), 1);
  return kept;
}

/// Pieces without simplification.
inline Pattern FinePattern(const FlatCharts& charts) {
  const SeamGraph graph = SeamsOf(charts);
  return BuildPieces(charts, graph, AllVertices(graph));
}

inline bool OutlinesCross(const Piece& piece) {
  std::vector<LineSegment> segments;
  int base = 0;
  for (const Polyline& loop : OutlineOf(piece)) {
    const int n = static_cast<int>(loop.size());
    for (int k = 0; k < n; ++k)
      segments.push_back({loop[k], loop[(k + 1) % n], base + k, base + (k + 1) % n});
    base += n;
  }
  return AnyCross(segments);
}

/// A rectangle, its lower left corner at the origin.
inline Polyline Rectangle(double width, double height) {
  return {{0, 0}, {width, 0}, {width, height}, {0, height}};
}

inline double AreaOf(const std::vector<Polyline>& loops) {
  double area = 0;
  for (const Polyline& loop : loops) area += SignedArea(loop);
  return area;
}

/// A pattern of one piece per outline, each edge a border seam of its own.
inline Pattern PatternOfOutlines(const std::vector<Polyline>& outlines) {
  Pattern pattern;
  for (const Polyline& outline : outlines) {
    Piece piece;
    piece.id = static_cast<int>(pattern.pieces.size());
    piece.group = piece.id;
    piece.area = SignedArea(outline);
    OutlineLoop loop;
    for (const Point2& p : outline) {
      Seam seam;
      seam.id = static_cast<int>(pattern.seams.size());
      SeamSide side;
      side.piece = piece.id;
      side.first = static_cast<int>(loop.size());
      side.edges = 1;
      seam.sides.push_back(side);
      OutlinePoint point;
      point.at = p;
      point.seam = seam.id;
      loop.push_back(point);
      pattern.seams.push_back(seam);
    }
    piece.loops.push_back(loop);
    piece.cut = {outline};
    pattern.pieces.push_back(std::move(piece));
  }
  return pattern;
}

}  // namespace dcharts::test
