// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "common/params.h"
#include "planar/cone_proxy.h"
#include "surface/charts.h"
#include "surface/dual_distance.h"

namespace dcharts {

/// A chart while it grows.
struct GrowingChart {
  int seed = 0;
  ConeProxy proxy;
};

/// Seeds and proxies of charts (Section 3.1, "Initialization" and "Finding new proxies and seeds").
template <class MeshType>
class Seeds {
 public:
  explicit Seeds(const SurfaceGraph<MeshType>& surface) : surface_(surface), distance_(surface) {}

  /// `count` seeds by the farthest-point algorithm, the first at an extremity (the face farthest from the
  /// centroid of the surface); each of the next is the face farthest from the seeds so far. Components
  /// without a seed come first.
  std::vector<GrowingChart> FarthestPoints(int count) {
    const auto everywhere = [](int) { return true; };
    const auto wanted = static_cast<size_t>(std::min(count, surface_.FaceCount()));
    // Those of a smaller count come first.
    while (farthest_.size() < wanted) {
      const int next = farthest_.empty() ? Extremity(everywhere) : Farthest();
      if (!farthest_.empty() && distance_[next] <= 0) break;
      distance_.Extend({next}, everywhere);
      farthest_.push_back({next, ProxyAtSeed(next)});
    }
    return {farthest_.begin(), farthest_.begin() + std::min(wanted, farthest_.size())};
  }

  /// The best of the proxies of the three vertex rings of the seed: the one that fits the seed best.
  ConeProxy ProxyAtSeed(int seed) const {
    ConeProxy best;
    double best_error = 1e30;
    for (int i = 0; i < 3; ++i) {
      const int v = surface_.Vertex(3 * seed + i);
      NormalMoments moments;
      for (const int* h = surface_.RingBegin(v); h != surface_.RingEnd(v); ++h)
        moments.Add(surface_.Area(*h / 3), surface_.Normal(*h / 3));
      const ConeProxy proxy = FitCone(moments);
      const double error = FittingError(proxy, surface_.Normal(seed));
      if (error < best_error) {
        best_error = error;
        best = proxy;
      }
    }
    return best;
  }

  /// Proxy by Eq. 3 and seed (the most central of the best-fitting faces) of the chart made of `faces` (not
  /// empty).
  GrowingChart Refit(const std::vector<int>& faces, const Params& params) const {
    NormalMoments moments;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int f : faces) {
      moments.Add(surface_.Area(f), surface_.Normal(f));
      centre += surface_.Area(f) * surface_.Centroid(f);
    }
    GrowingChart chart;
    chart.proxy = FitCone(moments);
    chart.seed = faces.front();
    if (!(moments.area > 0)) return chart;
    centre /= moments.area;

    const auto share = static_cast<size_t>(params.seed_percent / 100 * static_cast<double>(faces.size()));
    const size_t candidates = std::min(faces.size(), std::max<size_t>(params.seed_candidates, share));
    std::vector<double> errors(faces.size());
    for (size_t k = 0; k < faces.size(); ++k)
      errors[k] = FittingError(chart.proxy, surface_.Normal(faces[k]));
    std::vector<double> sorted = errors;
    std::nth_element(sorted.begin(), sorted.begin() + (candidates - 1), sorted.end());
    // Equal errors are common (a plane: all are 0), so every face that ties with the k-th takes part.
    const double bound = sorted[candidates - 1] + 1e-12;
    double nearest = 1e300;
    for (size_t k = 0; k < faces.size(); ++k) {
      if (errors[k] > bound || surface_.Area(faces[k]) <= 0) continue;
      const double d = (surface_.Centroid(faces[k]) - centre).squaredNorm();
      if (d < nearest) {
        nearest = d;
        chart.seed = faces[k];
      }
    }
    return chart;
  }

 private:
  // The face farthest from the centroid of the surface, among those for which `among(face)` holds; -1 when
  // there is none.
  template <class Among>
  int Extremity(const Among& among) const {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int f = 0; f < surface_.FaceCount(); ++f) centre += surface_.Area(f) * surface_.Centroid(f);
    centre /= surface_.TotalArea();
    int best = -1;
    double farthest = -1;
    for (int f = 0; f < surface_.FaceCount(); ++f) {
      const double d = (surface_.Centroid(f) - centre).squaredNorm();
      if (surface_.Area(f) > 0 && d > farthest && among(f)) {
        farthest = d;
        best = f;
      }
    }
    return best;
  }

  // From the seeds so far; in components without one, the extremity of them all.
  int Farthest() {
    if (distance_.Reached().size() < static_cast<size_t>(surface_.FaceCount())) {
      const int unreached = Extremity([&](int f) { return distance_[f] == DualDistance<MeshType>::kFar; });
      if (unreached >= 0) return unreached;
    }
    // Distances only get less: a block of faces is looked at where it was farther than all before it.
    constexpr int kBlock = 64;
    block_farthest_.resize(surface_.FaceCount() / kBlock + 1, DualDistance<MeshType>::kFar);
    int best = 0;
    double farthest = -1;
    for (int begin = 0; begin < surface_.FaceCount(); begin += kBlock) {
      double& of_block = block_farthest_[begin / kBlock];
      if (of_block <= farthest) continue;
      of_block = -1;
      for (int f = begin; f < std::min(begin + kBlock, surface_.FaceCount()); ++f)
        if (surface_.Area(f) > 0 && distance_[f] > of_block) {
          of_block = distance_[f];
          if (of_block <= farthest) continue;
          farthest = of_block;
          best = f;
        }
    }
    return best;
  }

  const SurfaceGraph<MeshType>& surface_;
  DualDistance<MeshType> distance_;  // from all of farthest_
  std::vector<GrowingChart> farthest_;
  std::vector<double> block_farthest_;  // of each block of faces, or more
};

}  // namespace dcharts
