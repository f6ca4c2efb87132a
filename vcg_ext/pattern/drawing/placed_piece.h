// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pattern/pattern.h"

namespace dcharts {

/// One side of a seam on a piece, in the direction of the piece's loop: the piece is on the left.
struct SideRun {
  int seam = 0, side = 0;  ///< indices into Pattern::seams and its sides
  Polyline points;
};

/// A piece as it lies on a sheet: everything in the sheet's coordinates.
struct PlacedPiece {
  const Piece* piece = nullptr;
  PiecePlacement placement;
  std::vector<Polyline> net, cut;
  std::vector<SideRun> sides;
  Point2 low{0, 0}, high{0, 0};  ///< corners of the box of `cut`

  Point2 Turned(const Point2& direction) const;  ///< a direction of the piece on the sheet
  Polyline Placed(const Polyline& points) const;
};

PlacedPiece Place(const Pattern& pattern, const Piece& piece, const PiecePlacement& placement);

/// Lowest and highest corner of the loops' box.
std::pair<Point2, Point2> BoxOf(const std::vector<Polyline>& loops);

double LengthOf(const Polyline& points);

/// The point at an arc length of a polyline, and the unit direction there.
std::pair<Point2, Point2> AtLength(const Polyline& points, double length);

/// The arc length of the point of a polyline that is nearest to p.
double NearestLength(const Polyline& points, const Point2& p);

/// The part of a polyline between two arc lengths, from < to.
Polyline Part(const Polyline& points, double from, double to);

/// Where a ray (from a point, along a unit direction) meets the loops first, as a distance; negative:
/// nowhere.
double FirstHit(const Point2& from, const Point2& direction, const std::vector<Polyline>& loops);

}  // namespace dcharts
