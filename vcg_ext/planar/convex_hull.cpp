// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/convex_hull.h"

#include <algorithm>
#include <utility>

namespace dcharts {

std::vector<Eigen::Vector2d> ConvexHull(std::vector<Eigen::Vector2d> points) {
  // Andrew's monotone chain: the lower half from left to right, then the upper half back.
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::make_pair(a.x(), a.y()) < std::make_pair(b.x(), b.y());
  });
  std::vector<Eigen::Vector2d> hull;
  for (int half = 0; half < 2; ++half) {
    const size_t base = hull.size();
    for (const Eigen::Vector2d& q : points) {
      while (hull.size() >= base + 2) {
        const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2], b = q - hull.back();
        if (a.x() * b.y() - a.y() * b.x() > 0) break;
        hull.pop_back();
      }
      hull.push_back(q);
    }
    if (!hull.empty()) hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace dcharts
