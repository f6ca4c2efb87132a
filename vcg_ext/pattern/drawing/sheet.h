// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pattern/drawing/draft.h"
#include "pattern/drawing/drawing.h"

namespace dcharts {

/// Draws pieces with all their notation: one group for each. `placements`: where they lie on a sheet of this
/// size; labels keep out of its margin, mm.
std::vector<Group> PieceGroups(Draft& draft, const std::vector<const Piece*>& pieces,
                               const std::vector<PiecePlacement>& placements, double margin,
                               const Point2& sheet_size);

/// All drawn pieces on one sheet, with a strip above them that has title, scale bar and legend. The pieces
/// have the coordinates of Piece::on_sheet.
Drawing SheetOf(Draft& draft);

}  // namespace dcharts
