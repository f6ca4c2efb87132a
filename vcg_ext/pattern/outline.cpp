// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/outline.h"

#include <algorithm>
#include <cmath>

namespace dcharts {

Polyline PolylineOf(const OutlineLoop& loop) {
  Polyline line;
  for (const OutlinePoint& point : loop) line.push_back(point.at);
  return line;
}

std::vector<Polyline> OutlineOf(const Piece& piece) {
  std::vector<Polyline> loops;
  for (const OutlineLoop& loop : piece.loops) loops.push_back(PolylineOf(loop));
  return loops;
}

Polyline SideOf(const Pattern& pattern, const SeamSide& side) {
  const OutlineLoop& loop = pattern.pieces[side.piece].loops[side.loop];
  Polyline line;
  for (int k = 0; k <= side.edges; ++k) line.push_back(loop[(side.first + k) % loop.size()].at);
  if (side.backwards) std::reverse(line.begin(), line.end());
  return line;
}

OutlinePlace PlaceOnSide(const Pattern& pattern, const Seam& seam, int side_index, double arc) {
  const SeamSide& side = seam.sides[side_index];
  const OutlineLoop& loop = pattern.pieces[side.piece].loops[side.loop];
  const size_t size = loop.size();
  // The arc lengths of the run's corners, in the loop's direction; the last one is another seam's corner.
  const auto arc_at = [&](int k) {
    if (k < side.edges) return loop[(side.first + k) % size].arc;
    return side.backwards ? 0.0 : seam.length;
  };
  int edge = 0;
  while (edge + 1 < side.edges && (side.backwards ? arc_at(edge + 1) > arc : arc_at(edge + 1) < arc)) ++edge;
  const Point2 p = loop[(side.first + edge) % size].at, q = loop[(side.first + edge + 1) % size].at;
  const double from = arc_at(edge), span = arc_at(edge + 1) - from;
  const double t = span != 0 ? std::clamp((arc - from) / span, 0.0, 1.0) : 0;
  const Point2 along = q - p;
  const double length = along.norm();
  OutlinePlace place;
  place.at = p + t * along;
  if (length > 0) place.outward = {along.y() / length, -along.x() / length};
  return place;
}

}  // namespace dcharts
