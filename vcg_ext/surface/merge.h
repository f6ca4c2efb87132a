// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "common/params.h"
#include "common/progress.h"
#include "planar/cone_proxy.h"
#include "surface/charts.h"
#include "surface/dual_distance.h"
#include "surface/split_bad_charts.h"
#include "surface/straighten.h"

namespace dcharts {

/// The merge test of Section 3.3: two adjacent charts stay developable together when the boundary region
/// between them, the faces near the common boundary, is nearly a cylinder.
template <class MeshType>
class BoundaryRegion {
 public:
  explicit BoundaryRegion(const SurfaceGraph<MeshType>& surface) : surface_(surface), distance_(surface) {}

  /// Mean fitting error of the region's cylinder proxy (Eq. 3 with theta = pi/2) for the charts a and b,
  /// which meet in `border` (faces on both sides). `chart_area` is that of the smaller of the two.
  double Error(const ChartIds& ids, int a, int b, const std::vector<int>& border, double chart_area) {
    // The paper doesn't say how wide the region is. Thin bands always look like cylinders; this width keeps
    // the octants of a sphere apart.
    constexpr double kWidth = 0.25;
    distance_.Run(
        border, [&](int f) { return ids[f] == a || ids[f] == b; }, kWidth * std::sqrt(chart_area));
    NormalMoments moments;
    for (int f : distance_.Reached()) moments.Add(surface_.Area(f), surface_.Normal(f));
    return CylinderError(moments);
  }

 private:
  const SurfaceGraph<MeshType>& surface_;
  DualDistance<MeshType> distance_;
};

/// Merging charts (Section 3.3): the pair with the smallest error first, while it is below
/// params.merge_threshold, or, with params.target_charts, until there are no more than that.
template <class MeshType>
class Merger {
 public:
  Merger(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface), params_(params), progress_(progress), region_(surface) {}

  /// Every face must have a chart, every chart be one piece. A small threshold asks for charts that are
  /// strictly developable (mechanical parts): those that don't lie flat that well by themselves are halved
  /// first, unless there is a target, params.max_stretch is 0, or the threshold is 0 and nothing merges.
  void Run(ChartIds& ids) {
    if (params_.target_charts == 0 && params_.merge_threshold > 0 && StrictStretch() < params_.max_stretch) {
      SplitBadCharts(surface_, StrictStretch(), progress_, ids);
      // By the default: a user who only merges has no say in how.
      const Params defaults;
      StraightenBorders(surface_, defaults, progress_, ids);
    }
    Prepare(ids);
    using Item =
        std::tuple<double, int, int, int>;  // error, charts, and the pair's version when it was measured
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    auto push = [&](int a, int b) {
      if (kept_apart_[a].count(b) > 0) return;
      const double error = PairError(ids, a, b);
      if (params_.target_charts > 0 || error < params_.merge_threshold)
        queue.push({error, a, b, version_[a] + version_[b]});
    };
    for (const auto& pair : borders_) push(pair.first.first, pair.first.second);
    int merged = 0;
    const int charts = static_cast<int>(faces_.size());
    while (!queue.empty() && (params_.target_charts == 0 || charts - merged > params_.target_charts)) {
      const auto [error, a, b, version] = queue.top();
      queue.pop();
      if (faces_[a].empty() || faces_[b].empty() || version != version_[a] + version_[b]) continue;
      progress_.Update(static_cast<double>(++merged) / static_cast<double>(faces_.size()));
      Join(a, b, ids);
      for (int c : neighbours_[a]) push(std::min(a, c), std::max(a, c));
    }
    SplitAndCompact(surface_, ids);
  }

 private:
  // What the threshold stands for, as a bound on the L2 stretch of a chart: 1.0007 for the 1e-5 of mechanical
  // parts, and looser than the usual max_stretch for the 0.01 of all others.
  double StrictStretch() const {
    constexpr double kStretchPerNormal = 0.23, kStrictest = 1e-5;
    return 1 + kStretchPerNormal * std::sqrt(std::max(kStrictest, params_.merge_threshold));
  }

  void Prepare(const ChartIds& ids) {
    faces_ = FacesOfCharts(ids);
    area_.assign(faces_.size(), 0);
    version_.assign(faces_.size(), 0);
    neighbours_.assign(faces_.size(), {});
    borders_.clear();
    for (int f = 0; f < surface_.FaceCount(); ++f) area_[ids[f]] += surface_.Area(f);
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int g = surface_.Neighbour(h);
      if (g < 0 || ids[g] <= ids[h / 3]) continue;
      const int a = ids[h / 3], b = ids[g];
      auto& border = borders_[{a, b}];
      border.push_back(h / 3);
      border.push_back(g);
      neighbours_[a].insert(b);
      neighbours_[b].insert(a);
    }
    kept_apart_.assign(faces_.size(), {});
    for (const auto& [h, o] : surface_.Parted()) {
      if (ids[h / 3] == ids[o / 3]) continue;
      kept_apart_[ids[h / 3]].insert(ids[o / 3]);
      kept_apart_[ids[o / 3]].insert(ids[h / 3]);
    }
  }

  double PairError(const ChartIds& ids, int a, int b) {
    return region_.Error(ids, a, b, borders_.at({a, b}), std::min(area_[a], area_[b]));
  }

  // b becomes a part of a (a < b).
  void Join(int a, int b, ChartIds& ids) {
    for (int f : faces_[b]) ids[f] = a;
    faces_[a].insert(faces_[a].end(), faces_[b].begin(), faces_[b].end());
    faces_[b].clear();
    area_[a] += area_[b];
    ++version_[a];
    borders_.erase({a, b});
    for (int c : kept_apart_[b]) {
      kept_apart_[a].insert(c);
      kept_apart_[c].insert(a);
    }
    neighbours_[a].erase(b);
    for (int c : neighbours_[b]) {
      if (c == a) continue;
      const auto from = borders_.find({std::min(b, c), std::max(b, c)});
      auto& to = borders_[{std::min(a, c), std::max(a, c)}];
      to.insert(to.end(), from->second.begin(), from->second.end());
      borders_.erase(from);
      neighbours_[c].erase(b);
      neighbours_[c].insert(a);
      neighbours_[a].insert(c);
    }
    neighbours_[b].clear();
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
  BoundaryRegion<MeshType> region_;
  std::vector<std::vector<int>> faces_;
  std::vector<double> area_;
  std::vector<int> version_;  // a pair measured before one of its charts grew is out of date
  std::vector<std::set<int>> neighbours_;
  std::vector<std::set<int>> kept_apart_;                    // charts with a kept border between them
  std::map<std::pair<int, int>, std::vector<int>> borders_;  // faces on both sides of the common boundary
};

}  // namespace dcharts
