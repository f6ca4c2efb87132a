// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/seam_table.h"

#include <algorithm>
#include <string>

#include "pattern/drawing/number_text.h"
#include "pattern/drawing/sheet_marks.h"
#include "pattern/drawing/text_box.h"

namespace dcharts {

namespace {

constexpr double kSize = 2.6, kRow = 4, kBetween = 6;  // mm

struct Column {
  const char* title;
  double width;  // mm
};
constexpr Column kColumns[] = {{"order", 9}, {"seam", 9},   {"pieces", 17}, {"mm", 12},
                               {"ease", 11}, {"match", 15}, {"", 16}};
constexpr double kTableWidth = 9 + 9 + 17 + 12 + 11 + 15 + 16;

std::vector<std::string> Cells(const Seam& seam) {
  std::string pieces, match, kind;
  for (const SeamSide& side : seam.sides)
    pieces += (pieces.empty() ? "" : " to ") + std::to_string(side.piece + 1);
  if (!seam.match_points.empty()) {
    const auto by_number = [](const MatchPoint& a, const MatchPoint& b) { return a.number < b.number; };
    const auto [low, high] =
        std::minmax_element(seam.match_points.begin(), seam.match_points.end(), by_number);
    match = std::to_string(low->number);
    if (low != high) match += "-" + std::to_string(high->number);
  }
  if (seam.is_dart) kind = "dart";
  if (seam.IsBorder()) kind = "edge";
  if (seam.opening) kind = "opening";
  return {seam.order > 0 ? std::to_string(seam.order) : "",
          "S" + std::to_string(seam.id + 1),
          seam.IsBorder() || seam.is_dart ? std::to_string(seam.sides[0].piece + 1) : pieces,
          NumberText(seam.length, 1),
          NumberText(100 * seam.ease, 2) + " %",
          match,
          kind};
}

void AddRow(Group& group, const Point2& start, const std::vector<std::string>& cells) {
  double x = start.x();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!cells[c].empty())
      AddText(group, {x, start.y()}, cells[c], SizeToFit(cells[c], kSize, kColumns[c].width - 1));
    x += kColumns[c].width;
  }
}

void AddHead(Group& group, const Point2& start) {
  std::vector<std::string> titles;
  for (const Column& column : kColumns) titles.push_back(column.title);
  AddRow(group, start, titles);
  const Point2 line = start - Point2(0, 1.2);
  group.lines.push_back({Mark::kSheet, {line, line + Point2(kTableWidth - 2, 0)}});
}

}  // namespace

void AddSeamTable(const Pattern& pattern, double margin, double top, std::vector<Drawing>& pages) {
  std::vector<const Seam*> seams;
  for (const Seam& seam : pattern.seams) seams.push_back(&seam);
  std::stable_sort(seams.begin(), seams.end(), [](const Seam* a, const Seam* b) {
    return (a->order > 0 ? a->order : 1 << 30) < (b->order > 0 ? b->order : 1 << 30);
  });
  const Point2 size = pages.back().size;
  const double first_row = 2 * kRow + 1;
  double y = top - first_row, x = margin;
  bool new_column = true;
  for (const Seam* seam : seams) {
    if (y < margin + kRow) {
      x += kTableWidth + kBetween;
      new_column = true;
      y = top - first_row;
    }
    if (x + kTableWidth > size.x() - margin || y < margin + kRow) {
      Drawing page;
      page.title = pages.back().title;
      page.size = size;
      const std::string number = std::to_string(pages.size() + 1);
      page.groups.push_back({"assembly-" + number, "Assembly " + number});
      pages.push_back(std::move(page));
      top = size.y() - margin;
      x = margin;
      y = top - first_row;
      new_column = true;
    }
    Group& group = pages.back().groups[0];
    if (new_column) AddHead(group, {x, top - kRow});
    new_column = false;
    AddRow(group, {x, y}, Cells(*seam));
    y -= kRow;
  }
}

double SeamTableWidth() { return kTableWidth; }

}  // namespace dcharts
