// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pattern/drawing/drawing.h"

namespace dcharts {

/// Writes the table of seams in the order of sewing: on the last page from `top` (mm) downwards, as many
/// columns as fit, and on more pages like it. Per seam: its number, pieces, length, ease, match points, and
/// what it is.
void AddSeamTable(const Pattern& pattern, double margin, double top, std::vector<Drawing>& pages);

/// Of one column, mm.
double SeamTableWidth();

}  // namespace dcharts
