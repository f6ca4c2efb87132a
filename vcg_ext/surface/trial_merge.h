// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/params.h"
#include "common/progress.h"
#include "surface/chart_trial.h"
#include "surface/charts.h"
#include "surface/coarsen.h"
#include "surface/split_chart.h"

namespace dcharts {

/// Merging charts by trial flattening: of all pairs of neighbours, the one first that adds the least stretch
/// for the seam it saves. Takes the place of the merge test of Section 3.3.
template <class MeshType>
class TrialMerger {
 public:
  TrialMerger(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface), params_(params), progress_(progress), no_seams_(surface.FaceCount(), 0) {}

  /// Every face must have a chart. Charts that don't lie flat well by themselves are parted first; then
  /// charts are merged until there are params.target_charts, or, without a target, as long as the stretch of
  /// each stays within params.max_stretch, or, without a bound, as long as a shorter seam is worth the
  /// stretch.
  void Run(ChartIds& ids) {
    PartBadCharts(ids);
    const CoarseSurface coarse = CoarsenCharts(surface_, ids, kCoarseFaces);
    const SurfaceGraph<SurfaceMesh> coarse_graph(*coarse.mesh);
    const SeamMask no_coarse_seams(coarse_graph.FaceCount(), 0);
    PatchExtractor<SurfaceMesh> coarse_extractor(coarse_graph, no_coarse_seams);
    coarse_ = &coarse_extractor;
    coarse_faces_ = FacesOfCharts(coarse.ids);
    Prepare(ids);
    Merge(Bound());
    if (AboveTarget()) {
      progress_.Log("A chart had to exceed max_stretch for the number of charts asked for.");
      Merge(kNoBound);
    }
    for (int c = 0; c < static_cast<int>(charts_.size()); ++c)
      if (charts_[c].alive)
        for (int part : charts_[c].parts)
          for (int f : fine_faces_[part]) ids[f] = c;
    SplitAndCompact(surface_, ids);
  }

 private:
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();
  static constexpr int kCoarseFaces = 6000;  // in all: enough to rank merges
  // Stretch that a seam as long as the side of a square with the surface's area may cost, in L2 stretch of
  // the whole atlas.
  static constexpr double kSeamPrice = 0.002;

  /// A node of the tree of merges; the first ones, without children, are the charts before.
  struct Chart {
    std::vector<int> parts;  ///< charts before
    double area = 0;
    ChartTrial trial;  ///< of the coarse chart
    int first = -1, second = -1;
    bool alive = true;
    bool checked = false;           ///< lies flat on the fine surface
    std::map<int, double> borders;  ///< neighbour: length, while alive
  };

  /// What is known of the union of two charts.
  struct Union {
    bool tried = false;
    ChartTrial trial;   ///< when tried
    double energy = 0;  ///< a lower bound while not tried
    bool refused = false;
  };

  double Bound() const { return params_.max_stretch > 0 ? params_.max_stretch : kNoBound; }
  // The coarse chart is a little worse than the fine one.
  double CoarseBound() const {
    constexpr double kCoarseExcess = 1.3;
    return 1 + kCoarseExcess * (bound_ - 1);
  }

  bool AboveTarget() const { return params_.target_charts > 0 && alive_ > params_.target_charts; }

  // Each chart that doesn't lie flat within the bound is halved until it does.
  void PartBadCharts(ChartIds& ids) {
    constexpr double kGood = 1.01;
    const double bound = std::min(Bound(), kGood);
    PatchExtractor<MeshType> extractor(surface_, no_seams_);
    std::vector<char> good(surface_.FaceCount(), 0);
    for (bool again = true; again;) {
      again = false;
      std::vector<ChartPatch> patches;
      for (const auto& faces : FacesOfCharts(ids))
        if (!good[faces.front()]) patches.push_back(extractor.Extract(faces));
      std::vector<char> bad(patches.size(), 0);
      ParallelFor(static_cast<int>(patches.size()), progress_, [&](int k, const std::function<void()>& poll) {
        bad[k] = !TryChart(patches[k], bound, poll).flat;
      });
      int next_id = ChartCount(ids);
      for (size_t k = 0; k < patches.size(); ++k) {
        const std::vector<int>& faces = patches[k].faces;
        if (!bad[k] || faces.size() < 2) {
          for (int f : faces) good[f] = 1;
          continue;
        }
        again = true;
        const std::vector<int> side = Bisect(patches[k]);
        for (size_t i = 0; i < faces.size(); ++i)
          if (side[i] == 1) ids[faces[i]] = next_id;
        ++next_id;
      }
      if (again) SplitAndCompact(surface_, ids);
    }
  }

  void Prepare(const ChartIds& ids) {
    fine_faces_ = FacesOfCharts(ids);
    alive_ = static_cast<int>(fine_faces_.size());
    charts_.assign(fine_faces_.size(), {});
    for (int c = 0; c < alive_; ++c) charts_[c].parts = {c};
    for (int f = 0; f < surface_.FaceCount(); ++f) charts_[ids[f]].area += surface_.Area(f);
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int g = surface_.Neighbour(h);
      if (g >= 0 && ids[g] > ids[h / 3]) part_borders_[{ids[h / 3], ids[g]}] += surface_.Length(h);
    }
    std::vector<ChartPatch> patches;
    for (const Chart& c : charts_) patches.push_back(CoarsePatch(c.parts));
    ParallelFor(alive_, progress_, [&](int c, const std::function<void()>& poll) {
      charts_[c].trial = TryChart(patches[c], kNoBound, poll);
      charts_[c].checked = true;  // by PartBadCharts
    });
  }

  ChartPatch CoarsePatch(const std::vector<int>& parts) const {
    return coarse_->Extract(FacesOf(parts, coarse_faces_));
  }

  static std::vector<int> FacesOf(const std::vector<int>& parts, const std::vector<std::vector<int>>& of) {
    std::vector<int> faces;
    for (int part : parts) faces.insert(faces.end(), of[part].begin(), of[part].end());
    return faces;
  }

  static std::vector<int> PartsOf(const Chart& a, const Chart& b) {
    std::vector<int> parts(a.parts.size() + b.parts.size());
    std::merge(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), parts.begin());
    return parts;
  }

  // Merges until done, then has all charts checked on the fine surface; those that fail there are taken
  // apart, and merging goes on with other pairs.
  void Merge(double bound) {
    bound_ = bound;
    for (auto& entry : unions_) entry.second.tried &= entry.second.trial.flat;  // by another bound
    constexpr int kRounds = 8;
    for (int round = 0; round < kRounds; ++round) {
      StartQueue();
      while (!queue_.empty() && !(params_.target_charts > 0 && !AboveTarget())) {
        const auto [later, key, a, b, tried] = queue_.top();
        queue_.pop();
        if (!charts_[a].alive || !charts_[b].alive) continue;
        if (!tried)
          TryPair(a, b);
        else if (Worthwhile(key))
          Accept(a, b);
      }
      if (!UndoBadMerges()) return;
    }
  }

  bool Worthwhile(double key) const { return params_.target_charts > 0 || bound_ < kNoBound || key < 0; }

  void StartQueue() {
    queue_ = {};
    std::vector<int> owner(fine_faces_.size());
    for (int c = 0; c < static_cast<int>(charts_.size()); ++c) {
      charts_[c].borders.clear();
      if (charts_[c].alive)
        for (int part : charts_[c].parts) owner[part] = c;
    }
    for (const auto& [pair, length] : part_borders_) {
      const int a = owner[pair.first], b = owner[pair.second];
      if (a == b) continue;
      charts_[a].borders[b] += length;
      charts_[b].borders[a] += length;
    }
    std::vector<std::pair<int, int>> untried;
    for (int a = 0; a < static_cast<int>(charts_.size()); ++a)
      for (const auto& [b, length] : charts_[a].borders)
        if (a < b && !unions_[{a, b}].tried) untried.push_back({a, b});
    std::vector<ChartPatch> patches;
    for (const auto& [a, b] : untried) patches.push_back(CoarsePatch(PartsOf(charts_[a], charts_[b])));
    std::vector<ChartTrial> trials(untried.size());
    ParallelFor(static_cast<int>(untried.size()), progress_, [&](int k, const std::function<void()>& poll) {
      trials[k] = TryChart(patches[k], CoarseBound(), poll);
    });
    for (size_t k = 0; k < untried.size(); ++k) Record(untried[k].first, untried[k].second, trials[k]);
    for (int a = 0; a < static_cast<int>(charts_.size()); ++a)
      for (const auto& [b, length] : charts_[a].borders)
        if (a < b) Push(a, b);
  }

  void Record(int a, int b, const ChartTrial& trial) {
    Union& both = unions_[{a, b}];
    both.tried = true;
    both.trial = trial;
    // Of a refused one only the bound is known to be exceeded.
    const double stretch = trial.flat ? trial.stretch : std::min(trial.stretch, CoarseBound());
    const double area = charts_[a].area + charts_[b].area;
    both.energy = stretch > 0 ? ChartTrial{true, stretch, 0}.Energy(area) : 0;
  }

  void TryPair(int a, int b) {
    progress_.Poll();
    Record(a, b,
           TryChart(CoarsePatch(PartsOf(charts_[a], charts_[b])), CoarseBound(), [&] { progress_.Poll(); }));
    Push(a, b);
  }

  double Energy(int c) const { return charts_[c].trial.Energy(charts_[c].area); }

  // Queues a pair under what its merge costs, or costs at least, unless it is out of the question.
  void Push(int a, int b) {
    if (a > b) std::swap(a, b);
    const Union& both = unions_[{a, b}];
    if (both.refused || (both.tried && !both.trial.flat)) return;
    double cut = 0;
    if (both.tried) cut = both.trial.cut_length - charts_[a].trial.cut_length - charts_[b].trial.cut_length;
    const double seam = charts_[a].borders[b] - cut;
    const double key = (both.energy - Energy(a) - Energy(b)) / surface_.TotalArea() -
                       params_.seam_weight * kSeamPrice * seam / std::sqrt(surface_.TotalArea());
    // A tiny chart is hard to place once the charts around it are large: it comes first.
    constexpr double kTiny = 0.003;  // of the surface
    const bool later = std::min(charts_[a].area, charts_[b].area) > kTiny * surface_.TotalArea();
    queue_.push({later, key, a, b, both.tried});
  }

  void Accept(int a, int b) {
    Union& both = unions_[{a, b}];
    Chart merged;
    merged.parts = PartsOf(charts_[a], charts_[b]);
    merged.area = charts_[a].area + charts_[b].area;
    merged.trial = both.trial;
    merged.first = a;
    merged.second = b;
    // Near the bound the coarse chart doesn't tell.
    constexpr double kClearlyWithin = 0.5;
    if (both.trial.stretch - 1 > kClearlyWithin * (bound_ - 1)) {
      merged.checked = true;
      if (!GoodOnFineSurface(merged)) {
        both.refused = true;
        return;
      }
    }
    const int n = static_cast<int>(charts_.size());
    for (int x : {a, b})
      for (const auto& [c, length] : charts_[x].borders)
        if (c != a && c != b) merged.borders[c] += length;
    charts_.push_back(std::move(merged));
    charts_[a].alive = charts_[b].alive = false;
    --alive_;
    for (const auto& [c, length] : charts_[n].borders) {
      charts_[c].borders.erase(a);
      charts_[c].borders.erase(b);
      charts_[c].borders[n] = length;
      // Least energies are superadditive: E(abc) >= E(ac) + E(b).
      Union& next = unions_[{c, n}];
      next.energy = charts_[n].trial.Energy(charts_[n].area) + Energy(c);
      for (const auto& [x, other] : {std::pair{a, b}, std::pair{b, a}}) {
        const auto known = unions_.find({std::min(c, x), std::max(c, x)});
        if (known != unions_.end()) next.energy = std::max(next.energy, known->second.energy + Energy(other));
      }
      Push(c, n);
    }
  }

  bool GoodOnFineSurface(const Chart& chart) {
    PatchExtractor<MeshType> extractor(surface_, no_seams_);
    const ChartTrial trial =
        TryChart(extractor.Extract(FacesOf(chart.parts, fine_faces_)), bound_, [&] { progress_.Poll(); });
    return trial.flat;
  }

  bool UndoBadMerges() {
    bool undone = false;
    for (int c = 0; c < static_cast<int>(charts_.size()); ++c) {
      if (!charts_[c].alive || charts_[c].checked) continue;
      charts_[c].checked = true;
      if (GoodOnFineSurface(charts_[c])) continue;
      const int a = charts_[c].first, b = charts_[c].second;
      unions_[{a, b}].refused = true;
      charts_[c].alive = false;
      charts_[a].alive = charts_[b].alive = true;
      ++alive_;
      undone = true;
    }
    return undone;
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
  const SeamMask no_seams_;
  PatchExtractor<SurfaceMesh>* coarse_ = nullptr;
  std::vector<std::vector<int>> fine_faces_, coarse_faces_;  // of each part
  std::map<std::pair<int, int>, double> part_borders_;       // lengths
  std::vector<Chart> charts_;
  int alive_ = 0;
  double bound_ = 0;
  std::map<std::pair<int, int>, Union> unions_;
  using Item = std::tuple<bool, double, int, int, bool>;  // not tiny, key, charts, whether it is exact
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue_;
};

}  // namespace dcharts
