// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pattern/drawing/drawing.h"

namespace dcharts {

/// A drawing on a page, or a part of one.
struct PageView {
  std::shared_ptr<const Drawing> drawing;
  Point2 offset{0, 0};           ///< of the drawing's origin from the page's lower left corner, mm
  Point2 low{0, 0}, high{0, 0};  ///< only this rectangle of the page is drawn on; empty: all of it
};

struct Page {
  Point2 size{0, 0};  ///< mm, at most kLargestPage
  std::vector<PageView> views;
};

/// PDF 1.x knows no larger pages (200 inches), mm.
inline constexpr double kLargestPage = 5080;

/// The pages as a PDF file in true scale. Throws Error.
std::string PdfFile(const std::string& title, const std::vector<Page>& pages);

}  // namespace dcharts
