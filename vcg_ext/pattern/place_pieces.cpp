// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/place_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "common/pi.h"
#include "planar/polygon.h"
#include "planar/packing.h"
#include "planar/packing_board.h"
#include "planar/upright_box.h"

namespace dcharts {
namespace {

// The edges of the outer cut line: end points, two rows per edge.
Points2 EdgesOf(const Polyline& loop) {
  Points2 edges(2 * static_cast<Eigen::Index>(loop.size()), 2);
  for (size_t k = 0; k < loop.size(); ++k) {
    edges.row(2 * static_cast<Eigen::Index>(k)) = loop[k].transpose();
    edges.row(2 * static_cast<Eigen::Index>(k) + 1) = loop[(k + 1) % loop.size()].transpose();
  }
  return edges;
}

Points2 Turned(const Points2& points, double angle) {
  Eigen::Matrix2d r;
  r << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return points * r.transpose();
}

void PlaceOnSheet(const std::vector<Piece*>& pieces, bool rotate, double gap,
                  const std::function<void()>& poll, Pattern& pattern) {
  std::vector<Points2> outlines;
  double area = 0;
  for (const Piece* piece : pieces) {
    outlines.push_back(EdgesOf(piece->cut.front()));
    area += SignedArea(piece->cut.front());
  }
  // The gap as a share of a side that is not known yet: of one that is surely smaller.
  PackOptions options;
  options.rotate = rotate;
  options.texture_size = 4096;
  options.padding = static_cast<int>(std::ceil(gap / std::sqrt(area) * options.texture_size));
  options.padding = std::min(options.padding, options.texture_size / 16);
  const Packing packing = Pack(outlines, options, poll);
  const double side = 1 / packing.scale;
  Point2 low = Point2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (size_t k = 0; k < pieces.size(); ++k) {
    PiecePlacement& place = pieces[k]->on_sheet;
    place.page = 0;
    place.angle = packing.placements[k].angle;
    place.offset = side * packing.placements[k].offset;
    for (const Point2& p : pieces[k]->cut.front()) {
      low = low.cwiseMin(place(p));
      high = high.cwiseMax(place(p));
    }
  }
  const Point2 margin = Point2::Constant(kPageMargin);
  for (Piece* piece : pieces) piece->on_sheet.offset += margin - low;
  pattern.sheet_size = high - low + 2 * margin;
}

/// Puts pieces onto pages one after the other, the largest first, each on the first page with a place.
class Pager {
 public:
  /// `turns`: in how many directions pieces are tried.
  Pager(const Point2& printable, double gap, bool rotate, int turns)
      : gap_(gap), rotate_(rotate), turns_(rotate ? turns : 1) {
    constexpr double kMostCells = 400;  // along the page
    cell_ = std::max(1.0, printable.maxCoeff() / kMostCells);
    // A piece keeps half a gap to the margin as well; that much it may reach over it.
    columns_ = static_cast<int>((printable.x() + gap) / cell_);
    rows_ = static_cast<int>((printable.y() + gap) / cell_);
  }

  // False when the piece is larger than the page.
  bool Place(Piece& piece) {
    const Points2 edges = EdgesOf(piece.cut.front());
    const double upright = rotate_ ? UprightAngle(edges) : 0;
    const std::vector<Turn> turns = TurnsThatFit(edges, upright);
    for (size_t page = 0; !turns.empty(); ++page) {
      if (page == boards_.size()) {
        boards_.emplace_back(std::max(columns_, rows_) + 1);
        free_.push_back(columns_ * rows_);
      }
      int lowest = rows_ + 1;  // the board is larger than the page: a piece may not end beyond it
      const Turn* best = nullptr;
      int best_x = 0, best_y = 0;
      for (const Turn& turn : turns) {
        const RowRuns& cells = turn.cells;
        int x = 0, y = 0;
        if (turn.cell_count > free_[page]) continue;  // most pages are full, and searched in vain
        if (!boards_[page].FindLowest(cells, columns_, 0, lowest, &x, &y)) continue;
        lowest = y + cells.Height();
        best = &turn;
        best_x = x;
        best_y = y;
      }
      if (best == nullptr) continue;
      // The margin is there twice: the grid begins half a gap outside the printable part.
      piece.on_page.angle = best->angle;
      piece.on_page.offset =
          Point2(best_x * cell_, best_y * cell_) - best->corner.transpose() + Point2::Constant(kPageMargin);
      boards_[page].Take(best->cells, best_x, best_y);
      free_[page] -= best->cell_count;
      piece.on_page.page = static_cast<int>(page);
      pages_ = std::max(pages_, static_cast<int>(page) + 1);
      return true;
    }
    piece.on_page.page = -1;
    piece.on_page.angle = upright;
    return false;
  }

  int PageCount() const { return pages_; }

 private:
  struct Turn {
    double angle = 0;
    Eigen::RowVector2d corner;  // of the turned outline's box
    RowRuns cells;
    int cell_count = 0;
  };

  // Those at which a piece goes onto a page. Its cells are the same on all pages.
  std::vector<Turn> TurnsThatFit(const Points2& edges, double upright) const {
    constexpr int kMoreTurns = 72;  // for a large piece that goes onto a page askew only
    std::vector<Turn> fit = TurnsThatFit(edges, upright, turns_);
    return fit.empty() && rotate_ ? TurnsThatFit(edges, upright, kMoreTurns) : fit;
  }

  std::vector<Turn> TurnsThatFit(const Points2& edges, double upright, int turns) const {
    std::vector<Turn> fit;
    for (int t = 0; t < turns; ++t) {
      Turn turn;
      turn.angle = upright + 2 * kPi * t / turns;
      Points2 turned = Turned(edges, turn.angle);
      turn.corner = turned.colwise().minCoeff();
      turned.rowwise() -= turn.corner;
      const Eigen::RowVector2d size = turned.colwise().maxCoeff();
      if (size.x() > columns_ * cell_ || size.y() > rows_ * cell_) continue;  // no need for its cells
      turn.cells = CoveredCells(turned / cell_, gap_ / 2 / cell_);
      if (turn.cells.width > columns_ || turn.cells.Height() > rows_) continue;
      for (const std::vector<Run>& row : turn.cells.rows)
        for (const Run& run : row) turn.cell_count += run.last - run.first + 1;
      fit.push_back(std::move(turn));
    }
    return fit;
  }

  double gap_;
  bool rotate_;
  int turns_;
  double cell_ = 1;
  int columns_ = 0, rows_ = 0, pages_ = 0;
  std::vector<Board> boards_;
  std::vector<int> free_;  // cells of each page
};

void PlaceOnPages(const std::vector<Piece*>& pieces, PageFormat page, bool rotate, double gap,
                  const std::function<void()>& poll, Pattern& pattern) {
  pattern.page_size = PageSize(page);
  pattern.page_margin = kPageMargin;
  std::vector<Piece*> order = pieces;
  std::stable_sort(order.begin(), order.end(), [](const Piece* a, const Piece* b) {
    return SignedArea(a->cut.front()) > SignedArea(b->cut.front());
  });
  constexpr size_t kMany = 100;  // pieces; more would take long
  Pager pager(PrintableSize(page), gap, rotate, order.size() > kMany ? 8 : 16);
  for (Piece* piece : order) {
    if (poll) poll();
    if (pager.Place(*piece)) continue;
    Point2 low = Point2::Constant(std::numeric_limits<double>::infinity());
    piece->on_page.offset = {0, 0};
    for (const Point2& p : piece->cut.front()) low = low.cwiseMin(piece->on_page(p));
    piece->on_page.offset = Point2::Constant(kPageMargin) - low;
  }
  pattern.page_count = pager.PageCount();
}

}  // namespace

Point2 PageSize(PageFormat page) {
  switch (page) {
    case PageFormat::kSingleSheet:
      return {0, 0};
    case PageFormat::kA4:
      return {210, 297};
    case PageFormat::kA3:
      return {297, 420};
    case PageFormat::kA0:
      return {841, 1189};
    case PageFormat::kLetter:
      return {215.9, 279.4};
  }
  return {0, 0};
}

Point2 PrintableSize(PageFormat page) {
  if (page == PageFormat::kSingleSheet) return Point2::Constant(std::numeric_limits<double>::infinity());
  return PageSize(page) - Point2::Constant(2 * kPageMargin);
}

void PlacePieces(PageFormat page, bool rotate, double gap, const std::function<void()>& poll,
                 Pattern& pattern) {
  std::vector<Piece*> pieces;
  for (Piece& piece : pattern.pieces)
    if (piece.drawn && !piece.cut.empty()) pieces.push_back(&piece);
  if (pieces.empty()) return;
  PlaceOnSheet(pieces, rotate, gap, poll, pattern);
  if (page != PageFormat::kSingleSheet) PlaceOnPages(pieces, page, rotate, gap, poll, pattern);
}

}  // namespace dcharts
