// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "planar/row_runs.h"

namespace dcharts {

/// A square of cells, some taken. Remembers per cell the nearest taken one to its left, so that a run is
/// tested at once.
class Board {
 public:
  explicit Board(int side)
      : side_(side), taken_before_(static_cast<size_t>(side) * side, -1), gap_(side, side) {}

  /// Finds the place for `cells` with the smallest max(x + width, y + height), below `bound`; ties go to the
  /// lower place.
  bool FindNearest(const RowRuns& cells, int bound, int* best_x, int* best_y) const {
    bool found = false;
    int row = 0;
    for (int y = 0; y + cells.Height() < bound; ++y) {
      if (gap_[y + cells.widest_row] < cells.longest_run) continue;
      const int x = LeftmostFree(cells, y, bound - 1, &row);
      if (x < 0) continue;
      found = true;
      *best_x = x;
      *best_y = y;
      bound = std::max(x + cells.width, y + cells.Height());
    }
    return found;
  }

  /// Finds the lowest place for `cells` in columns 0..width-1, with its top below `bound`; ties go to the
  /// left.
  bool FindLowest(const RowRuns& cells, int width, int lowest, int bound, int* best_x, int* best_y) const {
    int row = 0;
    for (int y = lowest; y + cells.Height() < bound; ++y) {
      if (gap_[y + cells.widest_row] < cells.longest_run) continue;
      *best_x = LeftmostFree(cells, y, width, &row);
      *best_y = y;
      if (*best_x >= 0) return true;
    }
    return false;
  }

  void Take(const RowRuns& cells, int x, int y) {
    for (int row = 0; row < cells.Height(); ++row) {
      std::int16_t* taken = Row(y + row);
      for (const Run& run : cells.rows[row]) {
        const auto last = static_cast<std::int16_t>(x + run.last);
        for (int c = x + run.first; c <= last; ++c) taken[c] = static_cast<std::int16_t>(c);
        for (int c = last + 1; c < side_ && taken[c] < last; ++c) taken[c] = last;
      }
      int gap = 0;
      for (int c = side_ - 1; c >= 0; c = taken[c] - (taken[c] == c)) {
        gap = std::max(gap, c - taken[c]);
        if (taken[c] < 0) break;
      }
      gap_[y + row] = gap;
    }
  }

 private:
  // The smallest x, with x + cells.width <= width, at which `cells` fit with their foot at y; -1 when there
  // is none. Rows are visited in strides (neighbours tend to agree), beginning with the one that was in the
  // way last.
  int LeftmostFree(const RowRuns& cells, int y, int width, int* row) const {
    const int height = cells.Height();
    int stride = std::max(1, static_cast<int>(0.382 * height));
    while (std::gcd(stride, height) != 1) ++stride;
    int x = 0;
    for (int free_rows = 0; free_rows < height;) {
      if (x + cells.width > width) return -1;
      const int skip = Conflict(cells.rows[*row], y + *row, x);
      x += skip;
      if (skip > 0) {
        free_rows = 0;
        continue;
      }
      ++free_rows;
      *row += stride;
      if (*row >= height) *row -= height;
    }
    return x;
  }

  // How far to move right until the row's first run in conflict is free of it; 0 when none is.
  int Conflict(const std::vector<Run>& runs, int y, int x) const {
    const std::int16_t* taken = Row(y);
    for (const Run& run : runs) {
      const int before = taken[x + run.last];
      if (before >= x + run.first) return before - (x + run.first) + 1;
    }
    return 0;
  }

  const std::int16_t* Row(int y) const { return taken_before_.data() + static_cast<size_t>(y) * side_; }
  std::int16_t* Row(int y) { return taken_before_.data() + static_cast<size_t>(y) * side_; }

  int side_;
  std::vector<std::int16_t> taken_before_;
  std::vector<int>
      gap_;  // per row the longest stretch of free cells: rows that are full are passed over at once
};

}  // namespace dcharts
