// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pattern/pattern.h"

namespace dcharts {

/// Gives every seam but borders its match points ("reference points" of Section 4), at equal 3D arc length on
/// all sides, numbered from 1 through the pattern. The first from the seam's start is double where there are
/// several; a single one is nearer to the start: so no piece can be sewn in backwards.
void AddMatchPoints(Pattern& pattern);

/// Sets the order in which to sew: darts first, then seam by seam what joins most to what is joined already.
/// Of fabric, one seam stays open to turn and to stuff, and is closed last by hand: the shortest of those of
/// at least 80 mm, else the longest.
void SetSewingOrder(Pattern& pattern);

}  // namespace dcharts
