// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planar/chart_mesh.h"

namespace dcharts {

/// Cells first..last (both taken) of one row.
struct Run {
  int first, last;
};

/// The cells of a grid that a chart covers, row by row; each row's runs are sorted and apart.
struct RowRuns {
  int width = 0;  ///< cells; columns 0..width-1
  std::vector<std::vector<Run>> rows;
  int widest_row = 0;   ///< the row with the longest run...
  int longest_run = 0;  ///< ...and its cells
  int Height() const { return static_cast<int>(rows.size()); }
};

/// Cells that the chart, widened by `margin` cells in both directions, touches; its inside counts, holes
/// don't. `outline`: end points of the boundary edges, two rows per edge, in cells, with its box's lower left
/// corner at the origin; the widened chart's corner is at (0, 0) of the grid, so the chart itself is moved by
/// (margin, margin).
RowRuns CoveredCells(const Points2& outline, double margin);

/// The same of cells whose middle is inside, nearly: as large as the chart on average, where CoveredCells is
/// larger. At least one cell.
RowRuns MiddleCells(const Points2& outline, double margin);

}  // namespace dcharts
