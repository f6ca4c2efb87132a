// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/write_pattern.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "common/errors.h"
#include "pattern/drawing/assembly.h"
#include "pattern/drawing/dxf_writer.h"
#include "pattern/drawing/pdf_pages.h"
#include "pattern/drawing/save_file.h"
#include "pattern/drawing/sheet.h"
#include "pattern/drawing/sheet_marks.h"
#include "pattern/drawing/svg_writer.h"

namespace dcharts {

namespace {

std::string EndingOf(const std::string& path) {
  std::string ending = std::filesystem::u8path(path).extension().u8string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

// Pieces, and to the right of them how to put them together.
Drawing WholeSheet(const Pattern& pattern, const SurfaceData& mesh, const std::string& title,
                   std::vector<std::string>& unplaced) {
  const Point2 page(210, 297);
  constexpr double kMargin = 10;
  Drawing sheet = SheetOf(pattern, title, unplaced);
  for (const Drawing& drawing : AssemblyPages(pattern, mesh, title, page, kMargin, pattern.warnings)) {
    for (const Group& group : drawing.groups) sheet.groups.push_back(Moved(group, {sheet.size.x(), 0}));
    sheet.size = {sheet.size.x() + page.x(), std::max(sheet.size.y(), page.y())};
  }
  return sheet;
}

}  // namespace

void CheckOutputFile(const std::string& path) {
  const std::string ending = EndingOf(path);
  if (ending == ".svg" || ending == ".pdf" || ending == ".dxf") return;
  throw Error("output_file must end in .svg, .pdf or .dxf; you gave '" + path + "'.");
}

std::vector<std::string> WritePattern(const Pattern& pattern, const SurfaceData& mesh,
                                      const std::string& path) {
  CheckOutputFile(path);
  const std::string ending = EndingOf(path), title = std::filesystem::u8path(path).stem().u8string();
  std::vector<std::string> unplaced, sentences;
  if (ending == ".pdf")
    SaveFile(path, PdfFile(title, PdfPages(pattern, mesh, title, unplaced)));
  else if (ending == ".svg")
    SaveFile(path, SvgFile(WholeSheet(pattern, mesh, title, unplaced)));
  else
    SaveFile(path, DxfFile(SheetOf(pattern, title, unplaced)));
  sentences.push_back("Wrote " + path + ".");
  if (!unplaced.empty()) {
    std::string text = "These labels found no room: ";
    for (std::size_t i = 0; i < unplaced.size(); ++i) text += (i > 0 ? "; " : "") + unplaced[i];
    sentences.push_back(text + ".");
  }
  return sentences;
}

}  // namespace dcharts
