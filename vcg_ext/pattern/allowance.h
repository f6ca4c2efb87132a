// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pattern/pattern.h"

namespace dcharts {

/// Sets the cut lines of fabric: the net outlines widened by the seam allowance. In a dart narrower than two
/// allowances nothing is cut: the fabric stays there and is folded. Holes that the allowance fills are gone;
/// a pocket that it closes stays one, with a warning. Throws Error when the allowance is wider than every
/// piece; adds a warning for pieces that are narrower.
void AddAllowances(double allowance, Pattern& pattern);

}  // namespace dcharts
