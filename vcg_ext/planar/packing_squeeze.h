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
/// `side`: of the largest square, at most 128 cells for 200 charts (costs are 32-bit numbers). Makes at most
/// `most_moves` moves. Returns the side of the smallest square in which `spots` are then free of overlap, or
/// 0 when there was none below `side`, which leaves `spots` as they were. `poll` may throw. Always gives the
/// same for the same input; another `seed` is another search.
int Squeeze(const std::vector<std::vector<RowRuns>>& shapes, int side, int most_moves, unsigned seed,
            const std::function<void()>& poll, std::vector<Spot>* spots);

}  // namespace dcharts
