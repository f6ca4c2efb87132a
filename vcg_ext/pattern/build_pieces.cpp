// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/build_pieces.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/pi.h"
#include "pattern/outline.h"
#include "planar/polygon.h"

namespace dcharts {
namespace {

std::vector<OutlineLoop> LoopsOfChart(const FlatChart& chart, const std::vector<SeamPlace>& places,
                                      const SeamGraph& graph, const KeptVertices& kept) {
  std::vector<char> is_boundary(places.size());
  for (size_t h = 0; h < places.size(); ++h) is_boundary[h] = places[h].seam >= 0;
  const ChartBoundary boundary = BoundaryOf(chart, is_boundary);
  std::vector<char> done(chart.uv.rows(), 0);
  std::vector<OutlineLoop> loops;
  for (int v = 0; v < static_cast<int>(done.size()); ++v) {
    if (boundary.leaving[v] < 0 || done[v]) continue;
    OutlineLoop loop;
    size_t first = 0;  // where a run of edges begins
    for (int w = v; !done[w]; w = EndOf(chart, boundary.leaving[w])) {
      done[w] = 1;
      const SeamPlace& place = places[boundary.leaving[w]];
      const FineSeam& seam = graph.seams[place.seam];
      const bool backwards = seam.sides[place.side].backwards;
      const int k = backwards ? place.edge + 1 : place.edge;
      if (!kept[place.seam][k]) continue;
      if (k == (backwards ? seam.VertexCount() - 1 : 0)) first = loop.size();
      OutlinePoint point;
      point.at = chart.uv.row(w).transpose();
      point.seam = place.seam;
      point.side = place.side;
      point.arc = seam.arc[k];
      point.on_model = chart.mesh.positions.row(w).transpose();
      loop.push_back(point);
    }
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
    loops.push_back(std::move(loop));
  }
  // The outer loop is the one that encloses most.
  const auto outer = std::max_element(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
    return SignedArea(PolylineOf(a)) < SignedArea(PolylineOf(b));
  });
  if (outer != loops.end()) std::iter_swap(loops.begin(), outer);
  return loops;
}

double ModelArea(const ChartMesh& mesh) {
  double area = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::Vector3d a = mesh.positions.row(mesh.triangles(t, 0)),
                          b = mesh.positions.row(mesh.triangles(t, 1)),
                          c = mesh.positions.row(mesh.triangles(t, 2));
    area += (b - a).cross(c - a).norm() / 2;
  }
  return area;
}

FlatMesh FlatMeshOf(const FlatChart& chart) {
  FlatMesh flat;
  for (Eigen::Index v = 0; v < chart.uv.rows(); ++v) flat.vertices.push_back(chart.uv.row(v).transpose());
  for (Eigen::Index t = 0; t < chart.mesh.triangles.rows(); ++t)
    flat.triangles.push_back(
        {chart.mesh.triangles(t, 0), chart.mesh.triangles(t, 1), chart.mesh.triangles(t, 2)});
  flat.face = chart.source_face;
  return flat;
}

void FindSides(Pattern& pattern) {
  for (Piece& piece : pattern.pieces)
    for (int l = 0; l < static_cast<int>(piece.loops.size()); ++l) {
      const OutlineLoop& loop = piece.loops[l];
      for (int k = 0; k < static_cast<int>(loop.size()); ++k) {
        SeamSide& side = pattern.seams[loop[k].seam].sides[loop[k].side];
        if (side.edges == 0) {
          side.piece = piece.id;
          side.loop = l;
          side.first = k;
        }
        ++side.edges;
      }
    }
}

double AngleBetween(const Point2& a, const Point2& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

void MeasureSides(Pattern& pattern) {
  for (Seam& seam : pattern.seams)
    for (SeamSide& side : seam.sides) {
      const Polyline line = SideOf(pattern, side);
      side.length = 0;
      for (size_t k = 0; k + 1 < line.size(); ++k) side.length += (line[k + 1] - line[k]).norm();
    }
}

// A seam whose sides follow each other in one loop has its tip between them.
void FindDarts(Pattern& pattern) {
  for (Piece& piece : pattern.pieces) piece.darts.clear();
  for (Seam& seam : pattern.seams) {
    if (seam.sides.size() != 2 || seam.sides[0].piece != seam.sides[1].piece ||
        seam.sides[0].loop != seam.sides[1].loop || seam.closed)
      continue;
    Piece& piece = pattern.pieces[seam.sides[0].piece];
    const OutlineLoop& loop = piece.loops[seam.sides[0].loop];
    const int size = static_cast<int>(loop.size());
    for (int k : {0, 1}) {
      const SeamSide &in = seam.sides[k], &out = seam.sides[1 - k];
      if ((in.first + in.edges) % size != out.first || in.backwards == out.backwards) continue;
      const Point2 tip = loop[out.first].at;
      const Point2 before = loop[(out.first + size - 1) % size].at, after = loop[(out.first + 1) % size].at;
      double opening = AngleBetween(before - tip, after - tip);
      if (opening < 0) opening += 2 * kPi;
      piece.darts.push_back(
          {seam.id, seam.sides[0].loop, out.first, opening, std::max(in.length, out.length)});
      seam.is_dart = true;
    }
  }
}

}  // namespace

Pattern BuildPieces(const FlatCharts& charts, const SeamGraph& graph, const KeptVertices& kept) {
  Pattern pattern;
  for (size_t s = 0; s < graph.seams.size(); ++s) {
    const FineSeam& fine = graph.seams[s];
    Seam seam;
    seam.id = static_cast<int>(s);
    seam.length = fine.Length();
    seam.closed = fine.closed;
    for (const FineSide& side : fine.sides) {
      seam.sides.emplace_back();
      seam.sides.back().backwards = side.backwards;
    }
    pattern.seams.push_back(std::move(seam));
  }
  for (size_t c = 0; c < charts.charts.size(); ++c) {
    const FlatChart& chart = charts.charts[c];
    Piece piece;
    piece.id = static_cast<int>(c);
    piece.name = "Piece " + std::to_string(c + 1);
    piece.group = piece.id;
    piece.loops = LoopsOfChart(chart, graph.places[c], graph, kept);
    piece.model_area = ModelArea(chart.mesh);
    piece.flat = FlatMeshOf(chart);
    pattern.pieces.push_back(std::move(piece));
  }
  FindSides(pattern);
  MeasurePieces(pattern);
  return pattern;
}

void MeasurePieces(Pattern& pattern) {
  for (Piece& piece : pattern.pieces) {
    piece.area = 0;
    for (const OutlineLoop& loop : piece.loops) piece.area += SignedArea(PolylineOf(loop));
  }
  MeasureSides(pattern);
  FindDarts(pattern);
  pattern.largest_ease = pattern.total_seam_length = 0;
  for (Seam& seam : pattern.seams) {
    const auto [shortest, longest] =
        std::minmax_element(seam.sides.begin(), seam.sides.end(),
                            [](const SeamSide& a, const SeamSide& b) { return a.length < b.length; });
    if (seam.length > 0) seam.ease = (longest->length - shortest->length) / seam.length;
    pattern.largest_ease = std::max(pattern.largest_ease, seam.ease);
    if (!seam.IsBorder()) pattern.total_seam_length += seam.length;
  }
}

}  // namespace dcharts
