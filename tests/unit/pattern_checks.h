// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks that a pattern is sound in itself.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "common/surface_data.h"
#include "pattern/outline.h"
#include "pattern/pattern.h"
#include "pattern/segments.h"

namespace dcharts::test {

inline bool Finite(const std::vector<Polyline>& lines) {
  for (const Polyline& line : lines)
    for (const Point2& p : line)
      if (!p.allFinite()) return false;
  return true;
}

// Properly: both ends of each on different sides of the other, not just by rounding. Loops may touch, where a
// chart hangs together in a single vertex or has a slit.
inline bool Cross(const LineSegment& a, const LineSegment& b) {
  constexpr double kRounding = 1e-6;  // mm
  const auto apart = [](const LineSegment& line, const LineSegment& ends) {
    const double least = kRounding * (line.b - line.a).norm();
    const double p = Orient(line.a, line.b, ends.a), q = Orient(line.a, line.b, ends.b);
    return (p > least && q < -least) || (p < -least && q > least);
  };
  return apart(a, b) && apart(b, a);
}

inline bool OutlinesCross(const std::vector<Polyline>& loops) {
  std::vector<LineSegment> edges;
  for (const Polyline& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      edges.push_back({loop[k], loop[(k + 1) % loop.size()], 0, 0});
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (Cross(edges[i], edges[j])) return true;
  return false;
}

inline std::string WrongInPiece(const Piece& piece, const SurfaceData& mesh) {
  std::string wrong;
  if (piece.loops.empty() || !Finite(OutlineOf(piece))) return "an outline is not there or not finite\n";
  if (!(piece.area > 0) || !std::isfinite(piece.area)) wrong += "its area is not above 0\n";
  if (!(piece.model_area >= 0) || !std::isfinite(piece.model_area))
    wrong += "its area on the model is not there\n";
  if (OutlinesCross(OutlineOf(piece))) wrong += "the outline crosses itself\n";
  if (piece.cut.empty() || !Finite(piece.cut)) wrong += "no cut line, or not finite\n";
  for (const Tab& tab : piece.tabs)
    if (!Finite({tab.outline})) wrong += "a tab is not finite\n";
  for (const Fold& fold : piece.folds)
    if (!Finite({fold.line}) || !std::isfinite(fold.angle_degrees)) wrong += "a fold is not finite\n";
  if (!Finite({piece.flat.vertices, piece.net.vertices})) wrong += "a flat mesh is not finite\n";
  if (!Finite({{piece.grain, piece.label_at, piece.on_sheet.offset, piece.on_page.offset}}))
    wrong += "grain, label or place is not finite\n";
  for (int f : piece.flat.face)
    if (f < 0 || f >= static_cast<int>(mesh.faces.size())) return wrong + "a flat triangle of no face\n";
  return wrong;
}

inline std::string WrongInSeam(const Seam& seam, const Pattern& pattern) {
  if (seam.sides.empty()) return "no side\n";
  std::string wrong;
  for (const SeamSide& side : seam.sides) {
    if (side.piece < 0 || side.piece >= static_cast<int>(pattern.pieces.size()))
      return "a side of no piece\n";
    const auto& loops = pattern.pieces[static_cast<std::size_t>(side.piece)].loops;
    if (side.loop < 0 || side.loop >= static_cast<int>(loops.size())) return "a side of no loop\n";
    const int size = static_cast<int>(loops[static_cast<std::size_t>(side.loop)].size());
    if (side.first < 0 || side.first >= size || side.edges < 1 || side.edges > size)
      return "a side of no run\n";
    if (side.edges != seam.sides.front().edges) wrong += "sides have other numbers of edges\n";
    if (!std::isfinite(side.length)) wrong += "a side's length is not finite\n";
  }
  if (!std::isfinite(seam.length) || !std::isfinite(seam.ease)) wrong += "length or ease is not finite\n";
  for (const MatchPoint& match : seam.match_points)
    if (match.at.size() != seam.sides.size() || !Finite({match.at, match.outward}))
      wrong += "match points are not finite, or not on every side\n";
  return wrong;
}

/// Everything is there and finite, indices are in range, outlines don't cross themselves. Returns what is
/// wrong, a line each; empty when all is well.
inline std::string WrongInPattern(const SurfaceData& mesh, const Pattern& pattern) {
  std::string wrong;
  if (pattern.pieces.empty()) return "no pieces\n";
  if (pattern.piece_of_face.size() != mesh.faces.size()) wrong += "piece_of_face has another size\n";
  for (const Piece& piece : pattern.pieces) {
    const std::string of_piece = WrongInPiece(piece, mesh);
    if (!of_piece.empty()) wrong += piece.name + ": " + of_piece;
  }
  for (const Seam& seam : pattern.seams) {
    const std::string of_seam = WrongInSeam(seam, pattern);
    if (!of_seam.empty()) wrong += "seam " + std::to_string(seam.id + 1) + ": " + of_seam;
  }
  return wrong;
}

}  // namespace dcharts::test
