// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pattern/pattern.h"

namespace dcharts {

/// The corners of a loop.
Polyline PolylineOf(const OutlineLoop& loop);

/// The corners of a piece's net outline, loop by loop.
std::vector<Polyline> OutlineOf(const Piece& piece);

/// The corners along one side of a seam, edges + 1 of them, in the seam's direction.
Polyline SideOf(const Pattern& pattern, const SeamSide& side);

/// A point of an outline, and the unit vector away from the piece there.
struct OutlinePlace {
  Point2 at{0, 0}, outward{0, 0};
};

/// Where 3D arc length `arc` of seam `seam` is on one of its sides.
OutlinePlace PlaceOnSide(const Pattern& pattern, const Seam& seam, int side, double arc);

}  // namespace dcharts
