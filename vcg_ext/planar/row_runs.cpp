// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/row_runs.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dcharts {
namespace {

void FindWidestRun(int row, RowRuns* cells) {
  for (const Run& run : cells->rows[row])
    if (run.last - run.first + 1 > cells->longest_run) {
      cells->longest_run = run.last - run.first + 1;
      cells->widest_row = row;
    }
}

}  // namespace

RowRuns CoveredCells(const Points2& outline, double margin) {
  RowRuns cells;
  const Eigen::RowVector2d size = outline.colwise().maxCoeff();
  cells.width = std::max(1, static_cast<int>(std::ceil(size.x() + 2 * margin)));
  cells.rows.resize(std::max(1, static_cast<int>(std::ceil(size.y() + 2 * margin))));
  std::vector<std::vector<std::pair<double, double>>> spans(cells.rows.size());
  std::vector<std::vector<double>> crossings(cells.rows.size());
  for (Eigen::Index e = 0; e + 1 < outline.rows(); e += 2) {
    Eigen::Vector2d a = outline.row(e), b = outline.row(e + 1);
    if (a.y() > b.y()) std::swap(a, b);
    const double slope = b.y() > a.y() ? (b.x() - a.x()) / (b.y() - a.y()) : 0;
    auto x_at = [&](double y) { return a.x() + slope * (y - a.y()); };
    // The widened edge touches rows a.y .. b.y + 2 margin (it is moved by one margin up).
    const int first = std::max(0, static_cast<int>(std::floor(a.y())));
    const int last = std::min(cells.Height() - 1, static_cast<int>(std::floor(b.y() + 2 * margin)));
    for (int row = first; row <= last; ++row) {
      double left = std::min(a.x(), b.x()), right = std::max(a.x(), b.x());
      if (b.y() > a.y()) {
        const double from = std::clamp(row - 2 * margin, a.y(), b.y()),
                     to = std::clamp(row + 1.0, a.y(), b.y());
        left = std::min(x_at(from), x_at(to));
        right = std::max(x_at(from), x_at(to));
      }
      spans[row].push_back({left, right + 2 * margin});
    }
    // The inside, from where the edge crosses the middle of a row. Half-open, so that a corner counts once.
    const int first_middle = std::max(0, static_cast<int>(std::ceil(a.y() + margin - 0.5)));
    for (int row = first_middle; row < cells.Height() && row + 0.5 < b.y() + margin; ++row)
      crossings[row].push_back(x_at(row + 0.5 - margin) + margin);
  }
  for (int row = 0; row < cells.Height(); ++row) {
    std::sort(crossings[row].begin(), crossings[row].end());
    for (size_t k = 0; k + 1 < crossings[row].size(); k += 2)
      spans[row].push_back({crossings[row][k], crossings[row][k + 1]});
    std::sort(spans[row].begin(), spans[row].end());
    for (const auto& [left, right] : spans[row]) {
      const int first = std::clamp(static_cast<int>(std::floor(left)), 0, cells.width - 1);
      const int last = std::clamp(static_cast<int>(std::ceil(right)) - 1, first, cells.width - 1);
      auto& runs = cells.rows[row];
      if (!runs.empty() && first <= runs.back().last + 1)
        runs.back().last = std::max(runs.back().last, last);
      else
        runs.push_back({first, last});
    }
    FindWidestRun(row, &cells);
  }
  return cells;
}

RowRuns MiddleCells(const Points2& outline, double margin) {
  RowRuns cells;
  const Eigen::RowVector2d size = outline.colwise().maxCoeff();
  cells.width = std::max(1, static_cast<int>(std::lround(size.x() + 2 * margin)));
  cells.rows.resize(std::max(1, static_cast<int>(std::lround(size.y() + 2 * margin))));
  std::vector<std::vector<double>> crossings(cells.rows.size());
  for (Eigen::Index e = 0; e + 1 < outline.rows(); e += 2) {
    Eigen::Vector2d a = outline.row(e), b = outline.row(e + 1);
    if (a.y() > b.y()) std::swap(a, b);
    for (int row = std::max(0, static_cast<int>(std::ceil(a.y() + margin - 0.5)));
         row < cells.Height() && row + 0.5 < b.y() + margin; ++row)
      crossings[row].push_back(a.x() + (b.x() - a.x()) * (row + 0.5 - margin - a.y()) / (b.y() - a.y()));
  }
  for (int row = 0; row < cells.Height(); ++row) {
    std::vector<Run>& runs = cells.rows[row];
    std::sort(crossings[row].begin(), crossings[row].end());
    for (size_t k = 0; k + 1 < crossings[row].size(); k += 2) {
      const int first = std::clamp(static_cast<int>(std::lround(crossings[row][k])), 0, cells.width - 1);
      const int last = std::clamp(static_cast<int>(std::lround(crossings[row][k + 1] + 2 * margin)) - 1,
                                  first, cells.width - 1);
      if (!runs.empty() && first <= runs.back().last + 1)
        runs.back().last = std::max(runs.back().last, last);
      else
        runs.push_back({first, last});
    }
    FindWidestRun(row, &cells);
  }
  if (cells.longest_run == 0) {
    cells.rows[0] = {{0, 0}};
    FindWidestRun(0, &cells);
  }
  return cells;
}

}  // namespace dcharts
