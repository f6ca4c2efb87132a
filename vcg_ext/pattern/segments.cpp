// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/segments.h"

#include <algorithm>
#include <cmath>

namespace dcharts {
namespace {

int Sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

bool InBox(const Point2& p, const LineSegment& s) {
  return p.x() >= std::min(s.a.x(), s.b.x()) && p.x() <= std::max(s.a.x(), s.b.x()) &&
         p.y() >= std::min(s.a.y(), s.b.y()) && p.y() <= std::max(s.a.y(), s.b.y());
}

}  // namespace

bool SegmentsCross(const LineSegment& s, const LineSegment& t) {
  const auto same = [](int i, int j) { return i >= 0 && i == j; };
  const bool aa = same(s.corner_a, t.corner_a), ab = same(s.corner_a, t.corner_b),
             ba = same(s.corner_b, t.corner_a), bb = same(s.corner_b, t.corner_b);
  const int common = aa + ab + ba + bb;
  if (common >= 2) return true;  // the same segment twice
  if (common == 1) {
    // They may only meet there: not lie on each other.
    const Point2& corner = aa || ab ? s.a : s.b;
    const Point2& p = aa || ab ? s.b : s.a;
    const Point2& q = aa || ba ? t.b : t.a;
    return Orient(corner, p, q) == 0 && (p - corner).dot(q - corner) > 0;
  }
  const int d1 = Sign(Orient(s.a, s.b, t.a)), d2 = Sign(Orient(s.a, s.b, t.b)),
            d3 = Sign(Orient(t.a, t.b, s.a)), d4 = Sign(Orient(t.a, t.b, s.b));
  if (d1 * d2 < 0 && d3 * d4 < 0) return true;
  return (d1 == 0 && InBox(t.a, s)) || (d2 == 0 && InBox(t.b, s)) || (d3 == 0 && InBox(s.a, t)) ||
         (d4 == 0 && InBox(s.b, t));
}

std::vector<int> CrossingSegments(const std::vector<LineSegment>& segments) {
  // By their left ends: only those whose boxes meet are compared.
  std::vector<int> order(segments.size());
  for (size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  const auto left = [&](int k) { return std::min(segments[k].a.x(), segments[k].b.x()); };
  const auto right = [&](int k) { return std::max(segments[k].a.x(), segments[k].b.x()); };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return left(i) < left(j); });
  std::vector<int> open, crossing;
  for (int k : order) {
    const LineSegment& s = segments[k];
    open.erase(std::remove_if(open.begin(), open.end(), [&](int j) { return right(j) < left(k); }),
               open.end());
    for (int j : open) {
      const LineSegment& t = segments[j];
      if (std::max(s.a.y(), s.b.y()) < std::min(t.a.y(), t.b.y()) ||
          std::max(t.a.y(), t.b.y()) < std::min(s.a.y(), s.b.y()))
        continue;
      if (!SegmentsCross(s, t)) continue;
      crossing.push_back(j);
      crossing.push_back(k);
    }
    open.push_back(k);
  }
  std::sort(crossing.begin(), crossing.end());
  crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
  return crossing;
}

double DistanceToSegment(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 e = b - a;
  const double length = e.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(e) / length, 0.0, 1.0) : 0;
  return (p - a - t * e).norm();
}

}  // namespace dcharts
