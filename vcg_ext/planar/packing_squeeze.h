// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "planar/row_runs.h"

namespace dcharts {

/// Where a chart is on a grid: which of its turns, and the cell of its box's lower left corner.
struct Spot {
  int turn = 0, x = 0, y = 0;
};

/// Makes the square smaller that charts lie in, by guided local search (after Egeblad, Nielsen, Odgaard
/// 2007): the square shrinks, the charts that now overlap go one by one where they overlap least, and pairs
/// that keep overlapping weigh more and more. `shapes`: per chart its turns. `spots` may overlap at first.
/// Makes at most `most_moves` moves. Returns the side of the smallest square in which `spots` are then free
/// of overlap, or 0 when there was none below `side`, which leaves `spots` as they were. `poll` may throw.
/// Always gives the same for the same input.
int Squeeze(const std::vector<std::vector<RowRuns>>& shapes, int side, int most_moves,
            const std::function<void()>& poll, std::vector<Spot>* spots);

/// Moves charts towards the square's corner, cell by cell, until none can go on. `shapes`: per chart. False
/// when the spots, only moved then, overlap from the start.
bool Slide(const std::vector<RowRuns>& shapes, int side, std::vector<Spot>* spots);

}  // namespace dcharts
