// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "common/params.h"
#include "pattern/pattern.h"

namespace dcharts {

/// A page's size, mm, upright; zero for a single sheet.
Point2 PageSize(PageFormat page);

/// What is left of a page within its margins, mm; infinite for a single sheet.
Point2 PrintableSize(PageFormat page);
constexpr double kPageMargin = 10;  ///< mm

/// Places the drawn pieces, as they are cut, on one sheet as small as can be, nearly square (Section 4:
/// "packs the charts into a square domain"), and, unless there is only a single sheet, on pages. They stay
/// apart by `gap` mm. `poll` may throw.
void PlacePieces(PageFormat page, bool rotate, double gap, const std::function<void()>& poll,
                 Pattern& pattern);

}  // namespace dcharts
