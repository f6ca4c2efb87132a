// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pattern/drawing/draft.h"
#include "pattern/drawing/drawing.h"

namespace dcharts {

/// How to put the pieces together: pictures of the model with numbered pieces, totals, and a table of the
/// seams in the order of sewing. As many pages of this size as it takes; `margin` stays free on each side.
/// The pattern's warnings are on the first page.
std::vector<Drawing> AssemblyPages(const Draft& draft, const Point2& page_size, double margin);

}  // namespace dcharts
