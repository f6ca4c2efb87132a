// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/net_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pattern/segments.h"

namespace dcharts {
namespace {

class EarCutter {
 public:
  explicit EarCutter(const std::vector<Polyline>& loops) {
    std::vector<std::vector<int>> holes;
    for (size_t l = 0; l < loops.size(); ++l) {
      std::vector<int> ring;
      for (const Point2& p : loops[l]) {
        ring.push_back(static_cast<int>(points_.size()));
        points_.push_back(p);
      }
      if (l == 0)
        ring_ = ring;
      else
        holes.push_back(ring);
    }
    // Those that reach furthest to the right first: the bridge goes to what is right of them.
    std::stable_sort(holes.begin(), holes.end(), [&](const auto& a, const auto& b) {
      return points_[Rightmost(a)].x() > points_[Rightmost(b)].x();
    });
    for (size_t k = 0; k < holes.size(); ++k) {
      std::vector<std::vector<int>> later(holes.begin() + static_cast<std::ptrdiff_t>(k), holes.end());
      Bridge(holes[k], later);
    }
  }

  std::vector<std::array<int, 3>> Run() {
    std::vector<std::array<int, 3>> triangles;
    while (ring_.size() > 3) {
      const size_t ear = BestEar();
      const size_t n = ring_.size();
      triangles.push_back({ring_[(ear + n - 1) % n], ring_[ear], ring_[(ear + 1) % n]});
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    if (ring_.size() == 3) triangles.push_back({ring_[0], ring_[1], ring_[2]});
    // Where corners lie on one line the last ears have no area; they are of no use.
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                                   [&](const auto& t) { return !(Area(t[0], t[1], t[2]) > 0); }),
                    triangles.end());
    return triangles;
  }

 private:
  double Area(int a, int b, int c) const { return Orient(points_[a], points_[b], points_[c]); }

  int Rightmost(const std::vector<int>& ring) const {
    return *std::max_element(ring.begin(), ring.end(),
                             [&](int a, int b) { return points_[a].x() < points_[b].x(); });
  }

  // A bridge to the nearest corner that can be seen.
  void Bridge(const std::vector<int>& hole, const std::vector<std::vector<int>>& other_rings) {
    size_t best_ring = 0, best_hole = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < ring_.size(); ++i)
      for (size_t j = 0; j < hole.size(); ++j) {
        const double distance = (points_[ring_[i]] - points_[hole[j]]).squaredNorm();
        if (distance >= nearest || !FacesInside(i, hole[j])) continue;
        if (!Sees(ring_[i], hole[j], other_rings)) continue;
        nearest = distance;
        best_ring = i;
        best_hole = j;
      }
    if (!std::isfinite(nearest)) return;
    std::vector<int> joined(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(best_ring) + 1);
    for (size_t k = 0; k <= hole.size(); ++k) joined.push_back(hole[(best_hole + k) % hole.size()]);
    joined.insert(joined.end(), ring_.begin() + static_cast<std::ptrdiff_t>(best_ring), ring_.end());
    ring_ = std::move(joined);
  }

  // Whether the way from corner i of the ring to a point begins inside. Of a corner that is there several
  // times, because of bridges, it is so for one.
  bool FacesInside(size_t i, int point) const {
    const size_t n = ring_.size();
    const int before = ring_[(i + n - 1) % n], at = ring_[i], after = ring_[(i + 1) % n];
    const bool left_of_before = Area(before, at, point) > 0, left_of_after = Area(at, after, point) > 0;
    return Area(before, at, after) > 0 ? left_of_before && left_of_after : left_of_before || left_of_after;
  }

  bool Sees(int a, int b, const std::vector<std::vector<int>>& other_rings) const {
    const LineSegment bridge{points_[a], points_[b], a, b};
    const auto free = [&](const std::vector<int>& ring) {
      for (size_t k = 0; k < ring.size(); ++k) {
        const int p = ring[k], q = ring[(k + 1) % ring.size()];
        if (SegmentsCross(bridge, {points_[p], points_[q], p, q})) return false;
      }
      return true;
    };
    return free(ring_) && std::all_of(other_rings.begin(), other_rings.end(), free);
  }

  bool IsEar(size_t i) const {
    const size_t n = ring_.size();
    const int a = ring_[(i + n - 1) % n], b = ring_[i], c = ring_[(i + 1) % n];
    if (!(Area(a, b, c) > 0)) return false;
    for (int v : ring_) {
      if (v == a || v == b || v == c) continue;
      if (Area(a, b, v) >= 0 && Area(b, c, v) >= 0 && Area(c, a, v) >= 0) return false;
    }
    return true;
  }

  // Smallest angle's tangent, roughly: area over the longest side squared.
  double Shape(size_t i) const {
    const size_t n = ring_.size();
    const Point2 &a = points_[ring_[(i + n - 1) % n]], &b = points_[ring_[i]],
                 &c = points_[ring_[(i + 1) % n]];
    return Orient(a, b, c) / std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
  }

  size_t BestEar() const {
    size_t best = ring_.size();
    double best_shape = -1;
    for (size_t i = 0; i < ring_.size(); ++i) {
      const double shape = Shape(i);
      if (shape <= best_shape || !IsEar(i)) continue;
      best_shape = shape;
      best = i;
    }
    if (best < ring_.size()) return best;
    // All that is left lies on a line, or touches itself: the flattest corner goes.
    best = 0;
    for (size_t i = 1; i < ring_.size(); ++i)
      if (std::abs(Shape(i)) < std::abs(Shape(best))) best = i;
    return best;
  }

  std::vector<Point2> points_;
  std::vector<int> ring_;
};

}  // namespace

std::vector<std::array<int, 3>> NetTriangles(const std::vector<Polyline>& loops) {
  if (loops.empty()) return {};
  return EarCutter(loops).Run();
}

}  // namespace dcharts
