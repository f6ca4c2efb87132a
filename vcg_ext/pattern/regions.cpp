// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/regions.h"

#include <algorithm>
#include <cmath>

#include <boost/polygon/polygon.hpp>

#include "common/errors.h"
#include "common/pi.h"
#include "pattern/segments.h"
#include "planar/polygon.h"

namespace dcharts {
namespace {

namespace bp = boost::polygon;
using GridPoint = bp::point_data<int>;
using GridPolygon = bp::polygon_data<int>;
using GridRegion = bp::polygon_with_holes_data<int>;
using GridSet = bp::polygon_set_data<int>;

// So that differences stay within int, as the polygon library asks.
constexpr double kLargest = 131072;  // mm

GridPoint ToGrid(const Point2& p) {
  if (!(p.cwiseAbs().maxCoeff() <= kLargest))
    throw Error("A flat piece would be larger than 130 m. Give a smaller size, or a smaller max_stretch.");
  return {static_cast<int>(std::lround(p.x() * kGridPerMm)),
          static_cast<int>(std::lround(p.y() * kGridPerMm))};
}

Point2 FromGrid(const GridPoint& p) { return {p.x() / kGridPerMm, p.y() / kGridPerMm}; }

void Insert(const Polyline& loop, bool is_hole, GridSet& set) {
  std::vector<GridPoint> points;
  for (const Point2& p : loop) {
    const GridPoint at = ToGrid(p);
    if (points.empty() || points.back() != at) points.push_back(at);
  }
  while (points.size() > 1 && points.front() == points.back()) points.pop_back();
  if (points.size() < 3) return;
  set.insert(GridPolygon(points.begin(), points.end()), is_hole);
}

void Insert(const Region& region, GridSet& set) {
  for (size_t k = 0; k < region.size(); ++k) Insert(region[k], k > 0, set);
}

template <class Polygon>
Polyline LoopOf(const Polygon& polygon, bool counterclockwise) {
  Polyline loop;
  for (auto it = polygon.begin(); it != polygon.end(); ++it) {
    const Point2 p = FromGrid(*it);
    if (loop.empty() || loop.back() != p) loop.push_back(p);
  }
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  // Points on a straight line are left over from the parts; on the grid that is exact.
  for (size_t k = 0; k < loop.size() && loop.size() > 3;) {
    const size_t n = loop.size();
    if (Orient(loop[(k + n - 1) % n], loop[k], loop[(k + 1) % n]) == 0)
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  }
  if ((SignedArea(loop) > 0) != counterclockwise) std::reverse(loop.begin(), loop.end());
  // The same first corner whatever the order of insertion.
  const auto first = std::min_element(loop.begin(), loop.end(), [](const Point2& a, const Point2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::rotate(loop.begin(), first, loop.end());
  return loop;
}

std::vector<Region> RegionsOf(const GridSet& set) {
  std::vector<GridRegion> polygons;
  set.get(polygons);
  std::vector<Region> regions;
  for (const GridRegion& polygon : polygons) {
    Region region{LoopOf(polygon, true)};
    for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole)
      region.push_back(LoopOf(*hole, false));
    if (region.front().size() >= 3) regions.push_back(std::move(region));
  }
  std::stable_sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) {
    return SignedArea(a.front()) > SignedArea(b.front());
  });
  return regions;
}

// By how much the outline turns to the left where an edge with outward normal m is followed by one with n:
// right back is pi, whatever rounding says.
double TurnBetween(const Point2& m, const Point2& n) {
  constexpr double kRightBack = 1e-6;
  const double turn = std::atan2(m.x() * n.y() - m.y() * n.x(), m.dot(n));
  return turn < -kPi + kRightBack ? kPi : turn;
}

// What a corner between edges with outward normals m and n adds outside.
Polyline CornerPiece(const Point2& at, const Point2& m, const Point2& n, double distance) {
  const double half = TurnBetween(m, n) / 2;
  Polyline corner{at, at + distance * m};
  constexpr double kSharpest = 60 * kPi / 180;  // radians left at the corner
  if (2 * half <= kPi - kSharpest) {
    corner.push_back(at + distance / std::cos(half) * (m + n).normalized());
  } else {
    constexpr double kStep = 10 * kPi / 180;
    const int steps = static_cast<int>(std::ceil(2 * half / kStep));
    // Just outside the circle, so that no point within `distance` is lost.
    const double radius = distance / std::cos(half / steps);
    for (int k = 0; k < steps; ++k) {
      const double angle = 2 * half * (k + 0.5) / steps, c = std::cos(angle), s = std::sin(angle);
      corner.push_back(at + radius * Point2(c * m.x() - s * m.y(), s * m.x() + c * m.y()));
    }
  }
  corner.push_back(at + distance * n);
  return corner;
}

}  // namespace

Point2 OnRegionGrid(const Point2& p) { return FromGrid(ToGrid(p)); }

std::vector<Region> UnionOf(const std::vector<Region>& regions) {
  GridSet set;
  for (const Region& region : regions) Insert(region, set);
  return RegionsOf(set);
}

double CommonArea(const std::vector<Region>& a, const std::vector<Region>& b) {
  GridSet in_a, in_b;
  for (const Region& region : a) Insert(region, in_a);
  for (const Region& region : b) Insert(region, in_b);
  using boost::polygon::operators::operator&=;
  in_a &= in_b;
  double area = 0;
  for (const Region& region : RegionsOf(in_a))
    for (const Polyline& loop : region) area += SignedArea(loop);
  return area;
}

std::vector<Region> Widened(const Region& region, double distance) {
  GridSet set;
  Insert(region, set);
  for (const Polyline& whole : region) {
    Polyline loop;  // without edges that have no length
    for (const Point2& p : whole)
      if (loop.empty() || p != loop.back()) loop.push_back(p);
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    const size_t n = loop.size();
    if (n < 3) continue;
    const auto normal = [&](size_t k) -> Point2 {
      const Point2 e = (loop[(k + 1) % n] - loop[k]).normalized();
      return {e.y(), -e.x()};
    };
    for (size_t k = 0; k < n; ++k) {
      const Point2 &p = loop[k], &q = loop[(k + 1) % n], m = normal(k), next = normal((k + 1) % n);
      Insert({p, p + distance * m, q + distance * m, q}, false, set);
      if (TurnBetween(m, next) > 0) Insert(CornerPiece(q, m, next, distance), false, set);
    }
  }
  return RegionsOf(set);
}

}  // namespace dcharts
