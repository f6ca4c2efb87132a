// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/overlap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/parallel.h"
#include "planar/boundary_loops.h"

namespace dcharts {
namespace {

std::int64_t Orientation(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by, std::int64_t cx,
                         std::int64_t cy) {
  return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
}

GridTriangle Counterclockwise(GridTriangle t) {
  if (TwiceArea(t) < 0) {
    std::swap(t[2], t[4]);
    std::swap(t[3], t[5]);
  }
  return t;
}

// True when all of b lies on or to the right of an edge of a (counterclockwise).
bool Separates(const GridTriangle& a, const GridTriangle& b) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    bool inside = false;
    for (int k = 0; k < 3 && !inside; ++k)
      inside = Orientation(a[2 * i], a[2 * i + 1], a[2 * j], a[2 * j + 1], b[2 * k], b[2 * k + 1]) > 0;
    if (!inside) return true;
  }
  return false;
}

struct Box {
  std::int32_t low[2], high[2];
  std::int32_t low_cell[2] = {0, 0}, high_cell[2] = {0, 0};  // of the grid: those with `low` and `high`
};

Box BoxOf(const GridTriangle& t) {
  Box box;
  for (int d : {0, 1}) {
    box.low[d] = std::min({t[d], t[2 + d], t[4 + d]});
    box.high[d] = std::max({t[d], t[2 + d], t[4 + d]});
  }
  return box;
}

}  // namespace

std::int64_t TwiceArea(const GridTriangle& t) { return Orientation(t[0], t[1], t[2], t[3], t[4], t[5]); }

bool Overlap(const GridTriangle& a, const GridTriangle& b) {
  if (TwiceArea(a) == 0 || TwiceArea(b) == 0) return false;
  const GridTriangle p = Counterclockwise(a), q = Counterclockwise(b);
  return !Separates(p, q) && !Separates(q, p);
}

std::vector<std::pair<int, int>> OverlappingPairs(const std::vector<GridTriangle>& triangles, size_t limit,
                                                  const std::function<void()>& poll) {
  std::vector<std::pair<int, int>> pairs;
  const int count = static_cast<int>(triangles.size());
  if (count < 2) return pairs;
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  std::int64_t low[2] = {INT32_MAX, INT32_MAX}, high[2] = {INT32_MIN, INT32_MIN};
  double mean_size[2] = {0, 0};
  for (const GridTriangle& t : triangles) {
    boxes.push_back(BoxOf(t));
    for (int d : {0, 1}) {
      low[d] = std::min<std::int64_t>(low[d], boxes.back().low[d]);
      high[d] = std::max<std::int64_t>(high[d], boxes.back().high[d]);
      mean_size[d] += (static_cast<double>(boxes.back().high[d]) - boxes.back().low[d]) / count;
    }
  }
  // Cells about as large as a triangle's box, but never many more cells than triangles.
  std::int64_t cells[2], cell_size[2];
  const double most = 2 * std::sqrt(static_cast<double>(count)) + 1;
  for (int d : {0, 1}) {
    const double extent = static_cast<double>(high[d] - low[d]) + 1;
    cells[d] = static_cast<std::int64_t>(std::clamp(extent / std::max(1.0, mean_size[d]), 1.0, most));
    cell_size[d] = static_cast<std::int64_t>(std::ceil(extent / static_cast<double>(cells[d])));
  }
  for (Box& box : boxes)
    for (int d : {0, 1}) {
      box.low_cell[d] = static_cast<std::int32_t>((box.low[d] - low[d]) / cell_size[d]);
      box.high_cell[d] = static_cast<std::int32_t>((box.high[d] - low[d]) / cell_size[d]);
    }
  auto for_cells = [&](int t, auto&& visit) {
    const Box& b = boxes[t];
    for (std::int64_t y = b.low_cell[1]; y <= b.high_cell[1]; ++y)
      for (std::int64_t x = b.low_cell[0]; x <= b.high_cell[0]; ++x)
        visit(static_cast<size_t>(y * cells[0] + x));
  };
  std::vector<int> start(cells[0] * cells[1] + 1, 0);
  for (int t = 0; t < count; ++t) for_cells(t, [&](size_t cell) { ++start[cell + 1]; });
  for (size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  if (poll) poll();
  std::vector<int> members(start.back()), fill(start.begin(), start.end() - 1);
  for (int t = 0; t < count; ++t) for_cells(t, [&](size_t cell) { members[fill[cell]++] = t; });

  // Of some cells that follow each other, until the limit.
  const auto pairs_in = [&](size_t begin, size_t end) {
    std::vector<std::pair<int, int>> found;
    for (size_t cell = begin; cell < end; ++cell)
      for (int m = start[cell]; m < start[cell + 1]; ++m)
        for (int n = m + 1; n < start[cell + 1]; ++n) {
          const int i = members[m], j = members[n];
          const Box &a = boxes[i], &b = boxes[j];
          if (a.low[0] >= b.high[0] || b.low[0] >= a.high[0] || a.low[1] >= b.high[1] ||
              b.low[1] >= a.high[1])
            continue;
          // A pair that shares several cells is taken in the one with the corner of the boxes' intersection.
          const size_t home = static_cast<size_t>(std::max(a.low_cell[1], b.low_cell[1]) * cells[0] +
                                                  std::max(a.low_cell[0], b.low_cell[0]));
          if (home != cell || !Overlap(triangles[i], triangles[j])) continue;
          found.push_back({i, j});
          if (found.size() >= limit) return found;
        }
    return found;
  };
  constexpr int kCellsPerPart = 32768;  // fewer are not worth a thread
  const size_t cell_count = start.size() - 1;
  const int parts = static_cast<int>(cell_count / kCellsPerPart) + 1;
  std::vector<std::vector<std::pair<int, int>>> found(parts);
  FirstThat(parts, poll, [&](int k, const std::function<void()>&) {
    found[k] = pairs_in(cell_count * k / parts, cell_count * (k + 1) / parts);
    return found[k].size() >= limit;
  });
  for (int k = 0; k < parts && pairs.size() < limit; ++k)
    pairs.insert(
        pairs.end(), found[k].begin(),
        found[k].begin() + static_cast<std::ptrdiff_t>(std::min(found[k].size(), limit - pairs.size())));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<GridTriangle> OnGrid(const Points2& uv, const Triangles& triangles) {
  constexpr double kCells = 1 << 28;
  const Eigen::RowVector2d low = uv.colwise().minCoeff();
  const double size = (uv.colwise().maxCoeff() - low).maxCoeff();
  const double scale = size > 0 ? kCells / size : 0;
  std::vector<std::array<std::int32_t, 2>> at(uv.rows());
  for (Eigen::Index v = 0; v < uv.rows(); ++v)
    for (int d : {0, 1}) at[v][d] = static_cast<std::int32_t>(std::lround((uv(v, d) - low[d]) * scale));
  std::vector<GridTriangle> grid(triangles.rows());
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int i = 0; i < 3; ++i)
      for (int d : {0, 1}) grid[f][2 * i + d] = at[triangles(f, i)][d];
  return grid;
}

Triangles RimOf(const Triangles& triangles) {
  const std::vector<std::vector<int>> loops = BoundaryLoops(triangles);
  if (loops.size() != 1) return triangles;
  std::vector<int> next(static_cast<size_t>(triangles.maxCoeff()) + 1, -1);
  for (size_t i = 0; i < loops[0].size(); ++i)
    next[static_cast<size_t>(loops[0][i])] = loops[0][(i + 1) % loops[0].size()];
  Triangles rim(triangles.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      if (next[static_cast<size_t>(triangles(t, k))] == triangles(t, (k + 1) % 3)) {
        rim.row(count++) = triangles.row(t);
        break;
      }
  return rim.topRows(count);
}

std::vector<std::pair<int, int>> OverlapsInMap(const Points2& uv, const Triangles& triangles, size_t limit,
                                               const std::function<void()>& poll) {
  const std::vector<GridTriangle> grid = OnGrid(uv, triangles);
  if (std::all_of(grid.begin(), grid.end(), [](const GridTriangle& t) { return TwiceArea(t) > 0; })) {
    const Triangles rim = RimOf(triangles);
    if (rim.rows() < triangles.rows() && OverlappingPairs(OnGrid(uv, rim), 1, poll).empty()) return {};
  }
  return OverlappingPairs(grid, limit, poll);
}

bool OverlapsItself(const Points2& uv, const Triangles& triangles, const std::function<void()>& poll) {
  return !OverlapsInMap(uv, triangles, 1, poll).empty();
}

}  // namespace dcharts
