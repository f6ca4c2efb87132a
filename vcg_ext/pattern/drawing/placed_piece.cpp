// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/placed_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace dcharts {

Point2 PlacedPiece::Turned(const Point2& direction) const {
  PiecePlacement turn = placement;
  turn.offset = {0, 0};
  return turn(direction);
}

Polyline PlacedPiece::Placed(const Polyline& points) const {
  Polyline placed;
  placed.reserve(points.size());
  for (const Point2& p : points) placed.push_back(placement(p));
  return placed;
}

PlacedPiece Place(const Pattern& pattern, const Piece& piece, const PiecePlacement& placement) {
  PlacedPiece placed;
  placed.piece = &piece;
  placed.placement = placement;
  for (const OutlineLoop& loop : piece.loops) {
    Polyline points;
    for (const OutlinePoint& p : loop) points.push_back(placement(p.at));
    placed.net.push_back(std::move(points));
  }
  for (const Polyline& loop : piece.cut) placed.cut.push_back(placed.Placed(loop));
  std::tie(placed.low, placed.high) = BoxOf(placed.cut);
  for (const Seam& seam : pattern.seams)
    for (std::size_t s = 0; s < seam.sides.size(); ++s) {
      const SeamSide& side = seam.sides[s];
      if (side.piece != piece.id) continue;
      const Polyline& loop = placed.net[side.loop];
      SideRun run{seam.id, static_cast<int>(s), {}};
      for (int i = 0; i <= side.edges; ++i) run.points.push_back(loop[(side.first + i) % loop.size()]);
      placed.sides.push_back(std::move(run));
    }
  return placed;
}

std::pair<Point2, Point2> BoxOf(const std::vector<Polyline>& loops) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::pair<Point2, Point2> box{{infinity, infinity}, {-infinity, -infinity}};
  for (const Polyline& loop : loops)
    for (const Point2& p : loop) {
      box.first = box.first.cwiseMin(p);
      box.second = box.second.cwiseMax(p);
    }
  return box;
}

double LengthOf(const Polyline& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

std::pair<Point2, Point2> AtLength(const Polyline& points, double length) {
  Point2 direction{1, 0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point2 way = points[i] - points[i - 1];
    const double step = way.norm();
    if (step > 0) direction = way / step;
    if (length <= step) return {points[i - 1] + length * direction, direction};
    length -= step;
  }
  return {points.back(), direction};
}

double NearestLength(const Polyline& points, const Point2& p) {
  double best = std::numeric_limits<double>::infinity(), at = 0, length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point2 way = points[i] - points[i - 1];
    const double step = way.norm();
    const double t = step > 0 ? std::clamp(way.dot(p - points[i - 1]) / (step * step), 0.0, 1.0) : 0;
    const double distance = (points[i - 1] + t * way - p).norm();
    if (distance < best) {
      best = distance;
      at = length + t * step;
    }
    length += step;
  }
  return at;
}

Polyline Part(const Polyline& points, double from, double to) {
  constexpr double kSamePoint = 1e-3;  // mm
  Polyline part = {AtLength(points, from).first};
  double length = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    length += (points[i] - points[i - 1]).norm();
    if (length > from + kSamePoint && length < to - kSamePoint) part.push_back(points[i]);
  }
  part.push_back(AtLength(points, to).first);
  return part;
}

double FirstHit(const Point2& from, const Point2& direction, const std::vector<Polyline>& loops) {
  double first = -1;
  for (const Polyline& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point2 a = loop[i], way = loop[(i + 1) % loop.size()] - a;
      const double cross = direction.x() * way.y() - direction.y() * way.x();
      if (cross == 0) continue;
      const Point2 to_a = a - from;
      const double distance = (to_a.x() * way.y() - to_a.y() * way.x()) / cross;
      const double t = (to_a.x() * direction.y() - to_a.y() * direction.x()) / cross;
      if (t >= 0 && t <= 1 && distance >= 0 && (first < 0 || distance < first)) first = distance;
    }
  return first;
}

}  // namespace dcharts
