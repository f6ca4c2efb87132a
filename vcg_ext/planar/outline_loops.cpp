// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/outline_loops.h"

#include <algorithm>
#include <map>
#include <utility>

#include "planar/polygon.h"

namespace dcharts {

using Vec = Eigen::Vector2d;

bool OutlineLoops(const Points2& outline, std::vector<std::vector<Vec>>* loops) {
  loops->clear();
  std::multimap<std::pair<double, double>, Vec> edges;
  for (Eigen::Index e = 0; e + 1 < outline.rows(); e += 2)
    if (outline.row(e) != outline.row(e + 1))
      edges.insert({{outline(e, 0), outline(e, 1)}, Vec(outline(e + 1, 0), outline(e + 1, 1))});
  while (!edges.empty()) {
    const Vec start(edges.begin()->first.first, edges.begin()->first.second);
    std::vector<Vec> loop;
    Vec at = start;
    do {
      const auto edge = edges.find({at.x(), at.y()});
      if (edge == edges.end()) return false;
      loop.push_back(at);
      at = edge->second;
      edges.erase(edge);
    } while (at != start);
    if (loop.size() >= 3) loops->push_back(std::move(loop));
  }
  for (size_t k = 0; k < loops->size(); ++k) {
    bool is_hole = false;
    for (size_t j = 0; j < loops->size(); ++j)
      if (j != k && IsInside((*loops)[j], (*loops)[k][0])) is_hole = !is_hole;
    if ((SignedArea((*loops)[k]) < 0) != is_hole) std::reverse((*loops)[k].begin(), (*loops)[k].end());
  }
  return !loops->empty();
}

std::vector<Vec> Simplified(const std::vector<Vec>& loop, double tolerance) {
  const size_t size = loop.size();
  if (size <= 3) return loop;
  const auto farthest = [&](size_t from, size_t to, double* distance) {
    const Vec a = loop[from], e = loop[to % size] - a;
    const double length = e.squaredNorm();
    size_t best = from;
    *distance = -1;
    for (size_t k = from + 1; k < to; ++k) {
      const Vec d = loop[k] - a;
      const double t = length > 0 ? std::clamp(d.dot(e) / length, 0.0, 1.0) : 0, apart = (d - t * e).norm();
      if (apart > *distance) {
        *distance = apart;
        best = k;
      }
    }
    return best;
  };
  std::vector<char> stays(size, 0);
  double distance = 0;
  const size_t middle = farthest(0, size, &distance);  // the first corner and the one farthest from it stay
  stays[0] = stays[middle] = 1;
  std::vector<std::pair<size_t, size_t>> parts{{0, middle}, {middle, size}};
  int kept = 2;
  while (!parts.empty()) {
    const auto [from, to] = parts.back();
    parts.pop_back();
    if (to - from < 2) continue;
    const size_t k = farthest(from, to, &distance);
    if (distance <= tolerance && (kept > 2 || !parts.empty())) continue;
    stays[k] = 1;
    ++kept;
    parts.push_back({k, to});
    parts.push_back({from, k});
  }
  std::vector<Vec> simple;
  for (size_t k = 0; k < size; ++k)
    if (stays[k]) simple.push_back(loop[k]);
  return simple;
}

}  // namespace dcharts
