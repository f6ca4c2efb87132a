// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pattern/pattern.h"

namespace dcharts {

/// Finds pieces of the same shape, as they are or mirrored: sets group and mirrored. Outlines count as the
/// same when, laid on each other, they are nowhere further apart than `tolerance` mm or 3 % of the piece's
/// size, whichever is less.
void FindCongruentPieces(double tolerance, Pattern& pattern);

/// Counts the copies of the pieces of each group. `merge`: only the first of a group is drawn, with all its
/// copies; otherwise every piece is drawn once.
void CountCopies(bool merge, Pattern& pattern);

}  // namespace dcharts
