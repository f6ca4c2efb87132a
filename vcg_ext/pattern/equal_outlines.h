// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pattern/pattern.h"

namespace dcharts {

/// Simplified edges are a little longer on one side of a seam than on the other. Moves the corners of the net
/// outlines, as little as can be and none further than `most_shift` (mm), so that the edges on all sides of a
/// seam get the same lengths. An outline that would cross itself stays nearer to what it was. Lengths, areas
/// and eases are measured anew.
void EqualizeOutlines(double most_shift, Pattern& pattern);

}  // namespace dcharts
