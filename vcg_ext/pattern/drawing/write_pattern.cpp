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
#include "pattern/drawing/seam_table.h"
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

// The file's name without its ending. Where a line ends, or an SVG and a DXF would be no such file any more,
// is a space.
std::string TitleOf(const std::string& path) {
  std::string title = std::filesystem::u8path(path).stem().u8string();
  for (char& c : title)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  return title;
}

// Pieces, and to the right of them how to put them together.
Drawing WholeSheet(Draft& draft) {
  const Point2 page(210, 297);
  constexpr double kMargin = 10;
  Drawing sheet = SheetOf(draft);
  for (const Drawing& drawing : AssemblyPages(draft, page, kMargin)) {
    const Point2 corner(sheet.size.x(), std::max(0.0, sheet.size.y() - page.y()));
    for (const Group& group : drawing.groups) sheet.groups.push_back(Moved(group, corner));
    sheet.size = {sheet.size.x() + page.x(), std::max(sheet.size.y(), page.y())};
  }
  return sheet;
}

// Pieces, and to the right of them the table of seams: a DXF has no pictures.
Drawing SheetWithTable(Draft& draft) {
  constexpr double kMargin = 10;
  Drawing sheet = SheetOf(draft);
  Drawing page;
  page.size = Point2(SeamTableWidth() + 2 * kMargin, std::max(sheet.size.y(), 297.0));
  page.groups.push_back({"seams", "Seams"});
  std::vector<Drawing> pages = {std::move(page)};
  AddSeamTable(draft.pattern, kMargin, pages[0].size.y() - kMargin, pages);
  for (const Drawing& drawing : pages) {
    for (const Group& group : drawing.groups) sheet.groups.push_back(Moved(group, {sheet.size.x(), 0}));
    sheet.size = {sheet.size.x() + drawing.size.x(), std::max(sheet.size.y(), drawing.size.y())};
  }
  return sheet;
}

// All of them, if they are few.
std::string NoRoomFor(const std::vector<std::string>& labels) {
  constexpr std::size_t kNamed = 6;
  const std::size_t named = labels.size() <= kNamed + 1 ? labels.size() : kNamed;
  std::string text =
      std::to_string(labels.size()) + (labels.size() == 1 ? " label" : " labels") + " found no room: ";
  for (std::size_t i = 0; i < named; ++i) text += (i > 0 ? "; " : "") + labels[i];
  if (named < labels.size()) text += "; and " + std::to_string(labels.size() - named) + " more";
  return text + ".";
}

}  // namespace

void CheckOutputFile(const std::string& path) {
  const std::string ending = EndingOf(path);
  if (ending != ".svg" && ending != ".pdf" && ending != ".dxf")
    throw Error("output_file must end in .svg, .pdf or .dxf; you gave '" + path + "'.");
  CheckCanBeSaved(path);
}

std::vector<std::string> WritePattern(const Pattern& pattern, const SurfaceData& mesh, const Params& params) {
  const std::string& path = params.output_file;
  CheckOutputFile(path);
  const std::string ending = EndingOf(path);
  Draft draft{pattern, mesh, TitleOf(path), params.print_texture};
  if (ending == ".pdf")
    SaveFile(path, PdfFile(draft.title, PdfPages(draft)));
  else if (ending == ".svg")
    SaveFile(path, SvgFile(WholeSheet(draft)));
  else
    SaveFile(path, DxfFile(SheetWithTable(draft)));
  std::vector<std::string> sentences = {"Wrote " + path + "."};
  if (!draft.unplaced.empty()) sentences.push_back(NoRoomFor(draft.unplaced));
  return sentences;
}

}  // namespace dcharts
