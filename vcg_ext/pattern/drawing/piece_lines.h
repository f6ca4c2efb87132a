// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pattern/drawing/drawing.h"
#include "pattern/drawing/placed_piece.h"

namespace dcharts {

/// A piece's lines in standard notation: cut line, stitch line, notches; of paper also folds, rulings and the
/// folds of tabs. Everything but labels and the grain arrow.
std::vector<Line> PieceLines(const Pattern& pattern, const PlacedPiece& placed);

}  // namespace dcharts
