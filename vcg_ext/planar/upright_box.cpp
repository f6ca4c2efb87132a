// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/upright_box.h"

#include "common/pi.h"
#include "planar/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace dcharts {
double UprightAngle(const Points2& points) {
  std::vector<Eigen::Vector2d> all;
  for (Eigen::Index k = 0; k < points.rows(); ++k) all.push_back(points.row(k));
  const std::vector<Eigen::Vector2d> hull = ConvexHull(std::move(all));
  double best_angle = 0, best_area = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < hull.size(); ++k) {
    const Eigen::Vector2d edge = hull[(k + 1) % hull.size()] - hull[k];
    if (!(edge.norm() > 0)) continue;
    const Eigen::Vector2d x = edge.normalized(), y(-x.y(), x.x());
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const Eigen::Vector2d& p : hull) {
      const double c[2] = {p.dot(x), p.dot(y)};
      for (int d : {0, 1}) {
        low[d] = std::min(low[d], c[d]);
        high[d] = std::max(high[d], c[d]);
      }
    }
    const double w = high[0] - low[0], h = high[1] - low[1];
    if (w * h >= best_area * (1 - 1e-9)) continue;
    best_area = w * h;
    best_angle = -std::atan2(x.y(), x.x()) + (w > h ? kPi / 2 : 0);
  }
  return best_angle;
}

}  // namespace dcharts
