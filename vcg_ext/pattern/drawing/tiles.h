// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pattern/drawing/draft.h"
#include "pattern/drawing/drawing.h"
#include "pattern/drawing/pdf_writer.h"

namespace dcharts {

/// A piece that is larger than the page, on pages that overlap.
struct Tiling {
  const Piece* piece = nullptr;
  std::shared_ptr<const Drawing> drawing;  ///< the whole piece, with registration marks
  Polyline outline;                        ///< what is cut, in the drawing's coordinates
  int columns = 0, rows = 0;
  std::vector<int> used;  ///< the tiles on which there is something, counted by rows from the upper left one
  Point2 tile{0, 0};      ///< size of the part of a page that is drawn on, mm
  Point2 step{0, 0};      ///< from a tile to the next one

  /// Lower left corner of a tile in the drawing.
  Point2 CornerOf(int index) const;
  /// "Piece 3, row 1 of 2, column 2 of 4"
  std::string NameOf(int index) const;
};

/// Tilings of the drawn pieces whose placement is on no page. Appends labels that found no room to
/// `unplaced`. Throws Error when they would take thousands of pages.
std::vector<Tiling> TilingsOf(Draft& draft);

/// The tile on a page of its own, without the page's marks.
PageView ViewOfTile(const Tiling& tiling, int index, double margin);

/// Adds a small picture of a tiling, with the number of each tile's page, in a square with this lower left
/// corner.
void AddTileMap(Group& group, const Tiling& tiling, int first_page, const Point2& corner, double side);

}  // namespace dcharts
