// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pattern/drawing/draft.h"
#include "pattern/drawing/pdf_writer.h"

namespace dcharts {

/// All pages of a pattern's PDF: assembly, page map, pages with whole pieces (or the single sheet), tiles of
/// larger pieces. Every page with pieces has a scale bar. Appends the labels that found no room to
/// `unplaced`.
std::vector<Page> PdfPages(Draft& draft);

}  // namespace dcharts
