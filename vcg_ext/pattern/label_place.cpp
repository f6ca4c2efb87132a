// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/label_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "pattern/segments.h"
#include "planar/polygon.h"

namespace dcharts {
namespace {

// Distance to the boundary: positive inside.
double Depth(const std::vector<Polyline>& loops, const Point2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Polyline& loop : loops)
    for (size_t k = 0; k < loop.size(); ++k)
      nearest = std::min(nearest, DistanceToSegment(p, loop[k], loop[(k + 1) % loop.size()]));
  return IsInside(loops, p) ? nearest : -nearest;
}

struct Cell {
  Point2 middle;
  double half = 0, depth = 0;
  double Most() const { return depth + half * std::sqrt(2.0); }
  bool operator<(const Cell& o) const { return Most() < o.Most(); }
};

}  // namespace

Circle LargestCircle(const std::vector<Polyline>& loops) {
  Circle best;
  if (loops.empty() || loops.front().empty()) return best;
  Point2 low = loops[0][0], high = low;
  for (const Polyline& loop : loops)
    for (const Point2& p : loop) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const double half = (high - low).maxCoeff() / 2;
  constexpr double kPrecise = 0.005;
  std::priority_queue<Cell> cells;
  const auto look = [&](const Point2& p, double h) {
    const Cell cell{p, h, Depth(loops, p)};
    if (cell.depth > best.radius) best = {p, cell.depth};
    if (cell.Most() > best.radius + kPrecise * half) cells.push(cell);
  };
  look((low + high) / 2, half);
  while (!cells.empty()) {
    const Cell cell = cells.top();
    cells.pop();
    if (cell.Most() <= best.radius + kPrecise * half) break;
    const double h = cell.half / 2;
    for (const double dx : {-h, h})
      for (const double dy : {-h, h}) look(cell.middle + Point2(dx, dy), h);
  }
  return best;
}

}  // namespace dcharts
