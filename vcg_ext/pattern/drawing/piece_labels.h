// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pattern/drawing/drawing.h"
#include "pattern/drawing/label_space.h"
#include "pattern/drawing/placed_piece.h"

namespace dcharts {

/// "cut 2", "cut 1 + 1 mirrored".
std::string QuantityText(const Piece& piece);

/// What is written along one side of a seam: "S12: 3 to 7", "S4 dart", "S9 edge"; `side` is that of the
/// piece it is written on.
std::string SeamText(const Pattern& pattern, const Seam& seam, int side);

/// Finds room for a piece's labels and its grain arrow and adds them to the piece's group and to the space,
/// where all lines of all pieces are already (with the piece's id as owner). A label is within its piece, or
/// has a leader line; it overlaps nothing. Returns the labels for which there was no room. `others`: all
/// pieces on the sheet.
std::vector<std::string> AddPieceLabels(const Pattern& pattern, const PlacedPiece& placed,
                                        const std::vector<PlacedPiece>& others, LabelSpace& space,
                                        Group& group);

}  // namespace dcharts
