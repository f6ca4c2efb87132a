// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/polygon.h"

#include <cstddef>

namespace dcharts {

using Vec = Eigen::Vector2d;

double SignedArea(const std::vector<Vec>& loop) {
  double twice = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec p = loop[k] - loop[0], q = loop[(k + 1) % loop.size()] - loop[0];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return twice / 2;
}

bool IsInside(const std::vector<Vec>& loop, const Vec& p) {
  bool inside = false;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec &a = loop[k], &b = loop[(k + 1) % loop.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

bool IsInside(const std::vector<std::vector<Vec>>& loops, const Vec& p) {
  bool inside = false;
  for (const std::vector<Vec>& loop : loops) inside ^= IsInside(loop, p);
  return inside;
}

}  // namespace dcharts
