// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "pattern/flat_charts.h"
#include "pattern/pattern.h"

namespace dcharts {

/// Gives a piece of paper its fold lines: where it bends by `least_degrees` or more along edges of the model.
/// Lines that go on straight are joined; they end at the net outline. Edges are left out that are no crease:
/// less than twice as sharp, and without any way to the outline or shorter than 12 mm in all.
void AddFolds(const FlatChart& chart, double least_degrees, Piece& piece);

/// Gives it rulings where it bends less sharply: straight lines along which it doesn't bend, at least
/// `least_spacing` mm apart, and a 200th of a large piece's size.
void AddRulings(const FlatChart& chart, double least_degrees, double least_spacing, Piece& piece);

/// The parts of the straight line from a to b that lie in the region.
std::vector<std::pair<Point2, Point2>> ClipToRegion(const Point2& a, const Point2& b,
                                                    const std::vector<Polyline>& loops);

}  // namespace dcharts
