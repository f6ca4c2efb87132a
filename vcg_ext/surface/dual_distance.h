// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "common/cheapest_first.h"
#include "surface/surface_graph.h"

namespace dcharts {

/// Shortest paths over face centroids: D(S,t) of Section 2.1.2. Keeps its arrays between runs, so that many
/// small runs on a large mesh cost only what they reach.
template <class MeshType>
class DualDistance {
 public:
  explicit DualDistance(const SurfaceGraph<MeshType>& surface)
      : surface_(surface), distance_(surface.FaceCount(), kFar) {}

  static constexpr double kFar = std::numeric_limits<double>::infinity();

  /// Distances from `sources` over faces for which `allowed(face)` holds, up to `limit`. Replaces the last
  /// run's.
  template <class Allowed>
  void Run(const std::vector<int>& sources, const Allowed& allowed, double limit = kFar) {
    for (int f : reached_) distance_[f] = kFar;
    reached_.clear();
    Extend(sources, allowed, limit);
  }

  /// Adds sources to the last run; only what they bring nearer is visited.
  template <class Allowed>
  void Extend(const std::vector<int>& sources, const Allowed& allowed, double limit = kFar) {
    for (int f : sources) Reach(f, 0);
    while (!queue_.IsEmpty()) {
      const auto [d, f] = queue_.Top();
      queue_.Pop();
      if (d > distance_[f]) continue;
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h);
        if (g < 0) continue;
        const double nd = d + surface_.Step(h);
        if (nd < distance_[g] && nd <= limit && allowed(g)) Reach(g, nd);
      }
    }
  }

  double operator[](int face) const { return distance_[face]; }
  const std::vector<int>& Reached() const { return reached_; }

 private:
  void Reach(int face, double d) {
    if (distance_[face] == kFar) reached_.push_back(face);
    distance_[face] = d;
    queue_.Push({d, face});
  }

  const SurfaceGraph<MeshType>& surface_;
  std::vector<double> distance_;
  std::vector<int> reached_;
  CheapestFirst<int> queue_;
};

}  // namespace dcharts
