// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/rounding.h"

#include <algorithm>

namespace dcharts {
namespace {

class Mender {
 public:
  Mender(const std::vector<int>& triangles, std::vector<std::int32_t>& x, std::vector<std::int32_t>& y)
      : triangles_(triangles), x_(x), y_(y) {}

  std::vector<int> Run() {
    std::vector<int> bad;
    for (int f = 0; f < FaceCount(); ++f)
      if (Area(f) <= 0) bad.push_back(f);
    if (bad.empty()) return bad;
    FindFacesAtVertices();
    constexpr int kPasses = 16;
    for (int pass = 0; pass < kPasses && !bad.empty(); ++pass) {
      for (int f : bad)
        for (int i = 0; i < 3 && Area(f) <= 0; ++i)
          MoveVertex(triangles_[3 * f + i], 1 << std::min(pass / 2, 4));
      bad.erase(std::remove_if(bad.begin(), bad.end(), [&](int f) { return Area(f) > 0; }), bad.end());
    }
    return bad;
  }

 private:
  int FaceCount() const { return static_cast<int>(triangles_.size() / 3); }

  static bool InRange(std::int32_t c) { return c >= 0 && c <= kTexcoordGrid; }

  std::int64_t Area(int f) const {
    const int a = triangles_[3 * f], b = triangles_[3 * f + 1], c = triangles_[3 * f + 2];
    return TwiceArea({x_[a], y_[a], x_[b], y_[b], x_[c], y_[c]});
  }

  void FindFacesAtVertices() {
    start_.assign(x_.size() + 1, 0);
    for (int v : triangles_) ++start_[v + 1];
    for (size_t v = 0; v + 1 < start_.size(); ++v) start_[v + 1] += start_[v];
    faces_.resize(triangles_.size());
    std::vector<int> fill(start_.begin(), start_.end() - 1);
    for (size_t k = 0; k < triangles_.size(); ++k) faces_[fill[triangles_[k]]++] = static_cast<int>(k / 3);
  }

  // The place within a few steps that mends the most faces around the vertex and spoils none; nearest first.
  void MoveVertex(int v, int step) {
    std::vector<int> good;
    int fewest = 0;
    for (int k = start_[v]; k < start_[v + 1]; ++k) {
      if (Area(faces_[k]) > 0)
        good.push_back(faces_[k]);
      else
        ++fewest;
    }
    auto bad_around = [&] {
      for (int f : good)
        if (Area(f) <= 0) return fewest;
      int bad = 0;
      for (int k = start_[v]; k < start_[v + 1]; ++k) bad += Area(faces_[k]) <= 0;
      return bad;
    };
    const std::int32_t x0 = x_[v], y0 = y_[v];
    std::int32_t best_x = x0, best_y = y0;
    constexpr int kReach = 3;
    for (int ring = 1; ring <= kReach && fewest > 0; ++ring)
      for (int dy = -ring; dy <= ring; ++dy)
        for (int dx = -ring; dx <= ring; ++dx) {
          if (std::max(std::abs(dx), std::abs(dy)) != ring) continue;
          x_[v] = x0 + dx * step;
          y_[v] = y0 + dy * step;
          if (!InRange(x_[v]) || !InRange(y_[v])) continue;
          const int bad = bad_around();
          if (bad >= fewest) continue;
          fewest = bad;
          best_x = x_[v];
          best_y = y_[v];
        }
    x_[v] = best_x;
    y_[v] = best_y;
  }

  const std::vector<int>& triangles_;
  std::vector<std::int32_t>&x_, &y_;
  std::vector<int> start_, faces_;
};

}  // namespace

std::vector<int> MendRoundedTriangles(const std::vector<int>& triangles, std::vector<std::int32_t>& x,
                                      std::vector<std::int32_t>& y) {
  return Mender(triangles, x, y).Run();
}

}  // namespace dcharts
