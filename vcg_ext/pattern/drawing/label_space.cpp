// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/label_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dcharts {

namespace {

constexpr double kCell = 8;  // mm

long long CellKey(long long x, long long y) { return (x << 32) ^ (y & 0xffffffffLL); }

// An edge of a separates it from b.
bool Separated(const std::vector<Point2>& a, const std::vector<Point2>& b, const Point2& axis) {
  const auto range = [&axis](const std::vector<Point2>& points) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point2& p : points) {
      low = std::min(low, axis.dot(p));
      high = std::max(high, axis.dot(p));
    }
    return std::make_pair(low, high);
  };
  const auto [low_a, high_a] = range(a);
  const auto [low_b, high_b] = range(b);
  return high_a < low_b || high_b < low_a;
}

bool SeparatedByAnEdgeOf(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point2 edge = a[(i + 1) % a.size()] - a[i];
    if (Separated(a, b, {-edge.y(), edge.x()})) return true;
    if (a.size() == 2 && Separated(a, b, edge)) return true;
  }
  return false;
}

std::vector<Point2> CornersOf(const Box& box) {
  const auto corners = box.Corners();
  return {corners.begin(), corners.end()};
}

Eigen::AlignedBox2d ExtentOf(const std::vector<Point2>& corners) {
  Eigen::AlignedBox2d extent;
  for (const Point2& p : corners) extent.extend(p);
  return extent;
}

}  // namespace

bool Overlap(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  return !SeparatedByAnEdgeOf(a, b) && !SeparatedByAnEdgeOf(b, a);
}

std::vector<Polyline> OutsideBoxes(const Point2& from, const Point2& to, const std::vector<Box>& boxes) {
  std::vector<std::pair<double, double>> hidden;  // ranges of the segment's parameter
  for (const Box& box : boxes) {
    double enter = 0, leave = 1;
    for (int d = 0; d < 2; ++d) {
      const Point2 axis = d == 0 ? box.AxisX() : box.AxisY();
      const double start = axis.dot(from - box.center), way = axis.dot(to - from);
      if (way == 0) {
        if (std::abs(start) > box.half[d]) leave = -1;
        continue;
      }
      const auto [near, far] = std::minmax({(-box.half[d] - start) / way, (box.half[d] - start) / way});
      enter = std::max(enter, near);
      leave = std::min(leave, far);
    }
    if (enter < leave) hidden.emplace_back(enter, leave);
  }
  std::sort(hidden.begin(), hidden.end());
  std::vector<Polyline> parts;
  double begin = 0;
  const auto add = [&](double end) {
    if (end > begin) parts.push_back({from + begin * (to - from), from + end * (to - from)});
  };
  for (const auto& [enter, leave] : hidden) {
    add(enter);
    begin = std::max(begin, leave);
  }
  add(1);
  return parts;
}

template <class Visit>
bool LabelSpace::AnyNear(const Eigen::AlignedBox2d& extent, Visit visit) const {
  const Point2 low = extent.min(), high = extent.max();
  for (long long x = std::llround(std::floor(low.x() / kCell)); x * kCell <= high.x(); ++x)
    for (long long y = std::llround(std::floor(low.y() / kCell)); y * kCell <= high.y(); ++y)
      if (visit(CellKey(x, y))) return true;
  return false;
}

// Whether one of the items that are `wanted` overlaps.
template <class Wanted>
bool LabelSpace::AnyMeets(const std::vector<Point2>& corners, Wanted wanted) const {
  const Eigen::AlignedBox2d extent = ExtentOf(corners);
  const auto meets = [&](int i) {
    const Item& item = items_[i];
    return item.extent.intersects(extent) && wanted(item) && Overlap(item.corners, corners);
  };
  return AnyNear(extent, [&](long long key) {
    const auto cell = cells_.find(key);
    return cell != cells_.end() && std::any_of(cell->second.begin(), cell->second.end(), meets);
  });
}

void LabelSpace::Add(std::vector<Point2> corners, int owner) {
  const int index = static_cast<int>(items_.size());
  const Eigen::AlignedBox2d extent = ExtentOf(corners);
  AnyNear(extent, [&](long long key) {
    cells_[key].push_back(index);
    return false;
  });
  items_.push_back({std::move(corners), extent, owner});
}

void LabelSpace::AddLine(const Polyline& points, bool closed, int owner) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    // Short steps, so that a long slanting line is not in all cells of its bounding box.
    const Point2 from = points[i], way = points[(i + 1) % n] - from;
    const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / kCell)));
    for (int k = 0; k < steps; ++k) Add({from + way * k / steps, from + way * (k + 1) / steps}, owner);
  }
}

void LabelSpace::AddBox(const Box& box) { Add(CornersOf(box), -1); }

bool LabelSpace::IsFree(const Box& box) const {
  const std::vector<Point2> corners = CornersOf(box);
  for (const Point2& p : corners)
    if ((p - low_).minCoeff() < 0 || (high_ - p).minCoeff() < 0) return false;
  return !AnyMeets(corners, [](const Item&) { return true; });
}

bool LabelSpace::IsFree(const Point2& from, const Point2& to, int owner) const {
  return !AnyMeets({from, to}, [&](const Item& item) { return owner < 0 || item.owner != owner; });
}

}  // namespace dcharts
