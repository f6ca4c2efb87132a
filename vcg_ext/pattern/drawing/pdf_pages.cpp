// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/pdf_pages.h"

#include <algorithm>
#include <utility>

#include "pattern/drawing/assembly.h"
#include "pattern/drawing/sheet.h"
#include "pattern/drawing/sheet_marks.h"
#include "pattern/drawing/text_box.h"
#include "pattern/drawing/tiles.h"

namespace dcharts {

namespace {

const Point2 kA4(210, 297);
constexpr double kA4Margin = 10;

std::shared_ptr<const Drawing> Shared(Drawing drawing) {
  return std::make_shared<const Drawing>(std::move(drawing));
}

Page PageOf(Drawing drawing) {
  const Point2 size = drawing.size;
  return {size, {{Shared(std::move(drawing)), {0, 0}, {0, 0}, {0, 0}}}};
}

class PageMaker {
 public:
  explicit PageMaker(Draft& draft) : draft_(draft), pattern_(draft.pattern), tilings_(TilingsOf(draft)) {}

  std::vector<Page> Make(const std::vector<Drawing>& assembly) {
    for (const Drawing& drawing : assembly) pages_.push_back(PageOf(drawing));
    const int first_piece_page = static_cast<int>(pages_.size()) + MapPageCount();
    AddMaps(first_piece_page + pattern_.page_count + 1);
    count_ = first_piece_page + pattern_.page_count;
    for (const Tiling& tiling : tilings_) count_ += static_cast<int>(tiling.used.size());
    for (int p = 0; p < pattern_.page_count; ++p) AddPieces(p);
    for (const Tiling& tiling : tilings_)
      for (int i : tiling.used) AddTile(tiling, i);
    return std::move(pages_);
  }

 private:
  static constexpr double kMap = 85;  // mm, side of a tile map

  Point2 Printable() const { return pattern_.page_size - Point2(2, 2) * pattern_.page_margin; }
  int MapColumns() const { return std::max(1, static_cast<int>(Printable().x() / kMap)); }
  int MapsPerPage() const {
    return MapColumns() * std::max(1, static_cast<int>((Printable().y() - 10) / kMap));
  }
  int MapPageCount() const { return (static_cast<int>(tilings_.size()) + MapsPerPage() - 1) / MapsPerPage(); }

  void AddMaps(int page_number) {
    for (std::size_t i = 0; i < tilings_.size();) {
      Drawing drawing{draft_.title, pattern_.page_size, {{"map", "Page map"}}};
      Group& group = drawing.groups[0];
      const double top = pattern_.page_size.y() - pattern_.page_margin;
      AddText(group, {pattern_.page_margin, top - 6},
              "How the pages of large pieces lie. Glue them on top of each other, mark on mark.",
              SizeToFit("How the pages of large pieces lie. Glue them on top of each other, mark on mark.", 4,
                        Printable().x()));
      for (int k = 0; k < MapsPerPage() && i < tilings_.size(); ++k, ++i) {
        const Point2 corner(pattern_.page_margin + k % MapColumns() * kMap,
                            top - 10 - (k / MapColumns() + 1) * kMap);
        AddTileMap(group, tilings_[i], page_number, corner, kMap - 5);
        page_number += static_cast<int>(tilings_[i].used.size());
      }
      pages_.push_back(PageOf(std::move(drawing)));
    }
  }

  // In the page's lower margin.
  Group Footer(const std::string& text) const {
    Group footer{"footer", "Footer"};
    const double y = 0.45 * pattern_.page_margin, size = 2.6;
    AddScaleBar(footer, {pattern_.page_margin, y}, 50);
    const std::string right =
        text + ", page " + std::to_string(pages_.size() + 1) + " of " + std::to_string(count_);
    AddText(footer, {pattern_.page_size.x() - pattern_.page_margin - size * TextWidth(right), y}, right,
            size);
    return footer;
  }

  void AddPieces(int page) {
    std::vector<const Piece*> pieces;
    std::vector<PiecePlacement> placements;
    for (const Piece& piece : pattern_.pieces) {
      if (!piece.drawn || piece.on_page.page != page) continue;
      pieces.push_back(&piece);
      placements.push_back(piece.on_page);
    }
    Drawing drawing{draft_.title, pattern_.page_size, {}};
    drawing.groups = PieceGroups(draft_, pieces, placements, pattern_.page_margin, pattern_.page_size);
    drawing.groups.push_back(Footer(draft_.title));
    pages_.push_back(PageOf(std::move(drawing)));
  }

  void AddTile(const Tiling& tiling, int index) {
    const double margin = pattern_.page_margin;
    Drawing marks{draft_.title, pattern_.page_size, {Footer(tiling.NameOf(index))}};
    const Point2 low(margin, margin), high = low + tiling.tile;
    marks.groups[0].lines.push_back(
        {Mark::kSheet, {low, {high.x(), low.y()}, high, {low.x(), high.y()}}, true});
    pages_.push_back(
        {pattern_.page_size,
         {ViewOfTile(tiling, index, margin), {Shared(std::move(marks)), {0, 0}, {0, 0}, {0, 0}}}});
  }

  Draft& draft_;
  const Pattern& pattern_;
  std::vector<Tiling> tilings_;
  std::vector<Page> pages_;
  int count_ = 0;
};

}  // namespace

std::vector<Page> PdfPages(Draft& draft) {
  const Pattern& pattern = draft.pattern;
  const bool single = pattern.page_size.minCoeff() <= 0;
  const std::vector<Drawing> assembly =
      AssemblyPages(draft, single ? kA4 : pattern.page_size, single ? kA4Margin : pattern.page_margin);
  if (!single) return PageMaker(draft).Make(assembly);
  std::vector<Page> pages;
  for (const Drawing& drawing : assembly) pages.push_back(PageOf(drawing));
  pages.push_back(PageOf(SheetOf(draft)));
  return pages;
}

}  // namespace dcharts
