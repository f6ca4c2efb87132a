// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/upright_box.h"

#include "common/pi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dcharts {
namespace {

// Counterclockwise hull, by Andrew's monotone chain.
std::vector<Eigen::Vector2d> ConvexHull(const Points2& points) {
  std::vector<Eigen::Vector2d> p;
  for (Eigen::Index k = 0; k < points.rows(); ++k) p.push_back(points.row(k));
  auto less = [](const auto& a, const auto& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); };
  std::sort(p.begin(), p.end(), less);
  std::vector<Eigen::Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const size_t base = hull.size();
    for (const Eigen::Vector2d& q : p) {
      while (hull.size() >= base + 2) {
        const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2], b = q - hull.back();
        if (a.x() * b.y() - a.y() * b.x() > 0) break;
        hull.pop_back();
      }
      hull.push_back(q);
    }
    hull.pop_back();
    std::reverse(p.begin(), p.end());
  }
  return hull;
}

}  // namespace

double UprightAngle(const Points2& points) {
  const std::vector<Eigen::Vector2d> hull = ConvexHull(points);
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
