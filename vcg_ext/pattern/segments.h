// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pattern/pattern.h"

namespace dcharts {

/// A straight line between two corners. Segments with a corner in common may touch there.
struct LineSegment {
  Point2 a{0, 0}, b{0, 0};
  int corner_a = -1, corner_b = -1;  ///< equal numbers: the same corner; -1: nobody else's
};

/// Twice the signed area of a triangle: positive when counterclockwise.
inline double Orient(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// True when two segments have a point in common, other than a common corner.
bool SegmentsCross(const LineSegment& s, const LineSegment& t);

/// Those that cross another one, sorted.
std::vector<int> CrossingSegments(const std::vector<LineSegment>& segments);

/// True when any two cross.
inline bool AnyCross(const std::vector<LineSegment>& segments) { return !CrossingSegments(segments).empty(); }

/// Distance of a point to the segment from a to b.
double DistanceToSegment(const Point2& p, const Point2& a, const Point2& b);

}  // namespace dcharts
