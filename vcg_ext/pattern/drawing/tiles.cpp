// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/tiles.h"

#include <algorithm>
#include <cmath>

#include "common/errors.h"
#include "pattern/drawing/label_space.h"
#include "pattern/drawing/number_text.h"
#include "pattern/drawing/placed_piece.h"
#include "pattern/drawing/sheet.h"
#include "pattern/drawing/sheet_marks.h"
#include "pattern/drawing/text_box.h"

namespace dcharts {

namespace {

constexpr double kOverlap = 15;        // mm
constexpr double kAround = 3;          // mm, least room around a piece
constexpr double kRegistration = 3.5;  // mm, half the size of a mark

// Nobody glues more pages together, and a larger PDF would take long to make.
constexpr double kMostTiles = 5000;

int TilesAlong(double length, double tile) {
  return std::max(1, static_cast<int>(std::ceil((length - kOverlap) / (tile - kOverlap) - 1e-9)));
}

// A cross in a diamond, in the middle of an overlap, so that it is on both pages.
void AddRegistration(Group& group, const Point2& at) {
  const Point2 x(kRegistration, 0), y(0, kRegistration);
  group.lines.push_back({Mark::kSheet, {at - x, at + x}});
  group.lines.push_back({Mark::kSheet, {at - y, at + y}});
  group.lines.push_back({Mark::kSheet, {at - x, at - y, at + x, at + y}, true});
}

// A line crosses the tile, or a text is on it.
bool HasSomething(const Group& group, const Point2& low, const Point2& size) {
  const std::vector<Point2> tile = {low, low + Point2(size.x(), 0), low + size, low + Point2(0, size.y())};
  for (const Line& line : group.lines)
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
      if (Overlap(tile, {line.points[i], line.points[(i + 1) % line.points.size()]})) return true;
  for (const Text& text : group.texts) {
    const auto corners = BoxOf(text).Corners();
    if (Overlap(tile, {corners.begin(), corners.end()})) return true;
  }
  return !group.pictures.empty();
}

Group Registrations(const Tiling& tiling) {
  Group marks{"registration", "Registration marks"};
  for (int r = 0; r < tiling.rows; ++r)
    for (int c = 0; c < tiling.columns; ++c) {
      const Point2 corner = tiling.CornerOf(r * tiling.columns + c);
      for (double t : {0.25, 0.75}) {
        if (c + 1 < tiling.columns)
          AddRegistration(marks, corner + Point2(tiling.tile.x() - kOverlap / 2, t * tiling.tile.y()));
        if (r + 1 < tiling.rows) AddRegistration(marks, corner + Point2(t * tiling.tile.x(), kOverlap / 2));
      }
    }
  return marks;
}

}  // namespace

Point2 Tiling::CornerOf(int index) const {
  return {index % columns * step.x(), (rows - 1 - index / columns) * step.y()};
}

std::string Tiling::NameOf(int index) const {
  return piece->name + ", row " + std::to_string(index / columns + 1) + " of " + std::to_string(rows) +
         ", column " + std::to_string(index % columns + 1) + " of " + std::to_string(columns);
}

std::vector<Tiling> TilingsOf(Draft& draft) {
  const Pattern& pattern = draft.pattern;
  std::vector<Tiling> tilings;
  double tiles = 0;
  for (const Piece& piece : pattern.pieces) {
    if (!piece.drawn || piece.on_page.page >= 0) continue;
    PiecePlacement placement{0, piece.on_page.angle, {0, 0}};
    const PlacedPiece turned = Place(pattern, piece, placement);
    Tiling tiling;
    tiling.piece = &piece;
    tiling.tile = pattern.page_size - Point2(2, 2) * pattern.page_margin;
    tiling.step = tiling.tile - Point2(kOverlap, kOverlap);
    auto drawing = std::make_shared<Drawing>();
    const Point2 least = turned.high - turned.low + Point2(2, 2) * kAround;
    tiling.columns = TilesAlong(least.x(), tiling.tile.x());
    tiling.rows = TilesAlong(least.y(), tiling.tile.y());
    tiles += static_cast<double>(tiling.columns) * tiling.rows;
    if (tiles > kMostTiles)
      throw Error("The large pieces would go over more than " + NumberText(kMostTiles, 0) +
                  " pages. Choose a larger page or 'Single sheet', or a smaller size.");
    drawing->size =
        tiling.tile + Point2((tiling.columns - 1) * tiling.step.x(), (tiling.rows - 1) * tiling.step.y());
    placement.offset = (drawing->size - turned.low - turned.high) / 2;
    drawing->groups = PieceGroups(draft, {&piece}, {placement}, 0, drawing->size);
    for (int i = 0; i < tiling.columns * tiling.rows; ++i)
      if (HasSomething(drawing->groups[0], tiling.CornerOf(i), tiling.tile)) tiling.used.push_back(i);
    drawing->groups.push_back(Registrations(tiling));
    tiling.outline = Place(pattern, piece, placement).cut.at(0);
    tiling.drawing = drawing;
    tilings.push_back(std::move(tiling));
  }
  return tilings;
}

PageView ViewOfTile(const Tiling& tiling, int index, double margin) {
  const Point2 corner(margin, margin);
  return {tiling.drawing, corner - tiling.CornerOf(index), corner, corner + tiling.tile};
}

void AddTileMap(Group& group, const Tiling& tiling, int first_page, const Point2& corner, double side) {
  const Point2 size = tiling.drawing->size;
  const double scale = (side - 8) / std::max(size.x(), size.y());
  const auto placed = [&](const Point2& p) { return Point2(corner + scale * p); };
  AddText(group, corner + Point2(0, side - 5), tiling.piece->name, 3);
  Polyline outline;
  for (const Point2& p : tiling.outline) outline.push_back(placed(p));
  group.lines.push_back({Mark::kCut, outline, true});
  for (std::size_t k = 0; k < tiling.used.size(); ++k) {
    const int i = tiling.used[k];
    const Point2 low = tiling.CornerOf(i), high = low + tiling.tile;
    group.lines.push_back(
        {Mark::kSheet,
         {placed(low), placed({high.x(), low.y()}), placed(high), placed({low.x(), high.y()})},
         true});
    const std::string number = std::to_string(first_page + static_cast<int>(k));
    const double room = 0.3 * scale * tiling.tile.minCoeff();
    AddText(group, placed(low) + Point2(0.15, 0.15) * scale * tiling.tile.minCoeff() + Point2(0.5, 0.5),
            number, std::clamp(room, 1.5, 5.0));
  }
}

}  // namespace dcharts
