// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "pattern/pattern.h"

namespace dcharts {

/// Gives the pieces of a paper model their tabs, `width` mm wide (0: none), and sets their cut lines: the net
/// outline with the tabs. Every stretch of a seam has its tab on one side; they alternate from side to side
/// along the seam, but go to the other side, or become narrower, where a tab would lie on its piece or on
/// another tab. Along teeth only some get one. A warning says how many found no place. `poll` may throw.
void AddTabs(double width, const std::function<void()>& poll, Pattern& pattern);

}  // namespace dcharts
