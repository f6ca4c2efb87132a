// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
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
#include "planar/overlap.h"
#include "surface/chart_parts.h"
#include "surface/chart_trial.h"
#include "surface/charts.h"
#include "surface/known_flattenings.h"
#include "surface/split_bad_charts.h"
#include "surface/stretch_darts.h"

namespace dcharts {

/// Merging charts by trial flattening: of all pairs of neighbours, the one first that adds the least stretch
/// for the seam it saves. Takes the place of the merge test of Section 3.3.
///
/// What is minimized, for a surface of area 1, is the symmetric Dirichlet energy (over 4, less 1) of all
/// charts plus kSeamPrice * params.seam_weight * length of all seams. Trials are made on a coarse copy of the
/// surface; what comes of them is checked on the surface itself.
template <class MeshType>
class TrialMerger {
 public:
  TrialMerger(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface), params_(params), progress_(progress) {}

  /// Every face must have a chart. Charts that don't lie flat well by themselves are split first; then charts
  /// are merged until there are params.target_charts, or, without a target, as long as the stretch of each
  /// stays within params.max_stretch, or, without a bound, as long as a shorter seam is worth the stretch.
  /// Flattenings of finished charts are left in `known`.
  void Run(ChartIds& ids, KnownFlattenings& known) {
    constexpr double kGood = 1.01;  // a segment that lies flat worse than this is better split
    known_ = &known;
    SplitBadCharts(surface_, std::min(Bound(), kGood), progress_, ids);
    ChartParts<MeshType> parts(surface_, ids);
    parts_ = &parts;
    Prepare();
    Merge(Bound());
    if (MayMergeMore() && Bound() < kNoBound) MergeWithDarts();
    if (AboveTarget()) Merge(kNoBound);
    Improve();
    for (int c = 0; c < static_cast<int>(charts_.size()); ++c)
      if (charts_[c].alive)
        for (int part : charts_[c].parts)
          for (int f : parts.FineFaces(part)) ids[f] = c;
    SplitAndCompact(surface_, ids);
  }

 private:
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();
  // Energy that a seam as long as the side of a square with the surface's area may cost.
  static constexpr double kSeamPrice = 0.00225;

  struct Chart {
    std::vector<int> parts{};
    double area = 0;
    ChartTrial trial{};           // of the coarse chart
    int first = -1, second = -1;  // what it was merged from
    bool alive = true;
    bool verified = false;            // lies flat on the fine surface
    std::map<int, double> borders{};  // neighbour: length; while the queue runs
  };

  // What is known of the union of two charts.
  struct Union {
    bool tried = false;
    ChartTrial trial{};       // when tried
    double least_energy = 0;  // times area
    bool refused = false;     // on the fine surface
  };

  double Bound() const { return params_.max_stretch > 0 ? std::max(1.0, params_.max_stretch) : kNoBound; }
  bool AboveTarget() const { return params_.target_charts > 0 && alive_ > params_.target_charts; }
  bool MayMergeMore() const { return params_.target_charts == 0 || AboveTarget(); }
  // The coarse chart is a little worse than the fine one.
  double CoarseBound() const {
    constexpr double kCoarseExcess = 1.3;
    return 1 + kCoarseExcess * (bound_ - 1);
  }
  double SeamCost(double length) const { return params_.seam_weight * kSeamPrice * length; }
  double Energy(int c) const { return charts_[c].trial.energy * charts_[c].area; }
  double CutLength(const ChartTrial& trial) const { return trial.cut_length / parts_->Unit(); }
  std::function<void()> Poll() {
    return [this] { progress_.Poll(); };
  }

  Chart Made(std::vector<int> of_parts) const {
    Chart chart;
    chart.parts = std::move(of_parts);
    for (int part : chart.parts) chart.area += parts_->Area(part);
    return chart;
  }

  std::vector<int> PartsOfBoth(int a, int b) const {
    const std::vector<int>&p = charts_[a].parts, &q = charts_[b].parts;
    std::vector<int> both(p.size() + q.size());
    std::merge(p.begin(), p.end(), q.begin(), q.end(), both.begin());
    return both;
  }

  void Prepare() {
    alive_ = parts_->Count();
    bound_ = kNoBound;
    std::vector<std::vector<int>> single(alive_);
    for (int c = 0; c < alive_; ++c) single[c] = {c};
    TryAll(single);
    for (int c = 0; c < alive_; ++c) {
      charts_.push_back(Made({c}));
      charts_.back().verified = true;  // by SplitBadCharts
      charts_.back().trial = Trial({c});
    }
  }

  // The trial of some parts together, each made once. One that was refused because of a bound is made again
  // for a larger one.
  const ChartTrial& Trial(const std::vector<int>& some) {
    auto& [bound, trial] = trials_[some];
    if (bound == 0 || (!trial.flat && bound < CoarseBound())) {
      progress_.Poll();
      bound = CoarseBound();
      trial = TryChart(parts_->CoarsePatch(some), bound, Poll());
    }
    return trial;
  }

  // Makes trials ahead, on all threads.
  void TryAll(const std::vector<std::vector<int>>& sets) {
    std::vector<const std::vector<int>*> open;
    std::vector<ChartPatch> patches;
    for (const std::vector<int>& some : sets)
      if (trials_.find(some) == trials_.end()) {
        open.push_back(&some);
        patches.push_back(parts_->CoarsePatch(some));
      }
    std::vector<ChartTrial> made(open.size());
    ParallelFor(static_cast<int>(open.size()), progress_, [&](int k, const std::function<void()>& poll) {
      made[k] = TryChart(patches[k], CoarseBound(), poll);
    });
    for (size_t k = 0; k < open.size(); ++k) trials_[*open[k]] = {CoarseBound(), made[k]};
  }

  // Merges until done, then has all charts checked on the fine surface; those that fail there are taken
  // apart, and merging goes on with other pairs.
  void Merge(double bound) {
    bound_ = bound;
    for (auto& entry : unions_) entry.second.tried &= entry.second.trial.flat;  // by another bound
    constexpr int kRounds = 12;
    for (int round = 0; round < kRounds; ++round) {
      GreedyMerge();
      if (!UndoBadMerges()) return;
    }
  }

  void GreedyMerge() {
    StartQueue();
    while (!queue_.empty() && MayMergeMore()) {
      const auto [later, key, a, b, tried] = queue_.top();
      queue_.pop();
      if (!charts_[a].alive || !charts_[b].alive) continue;
      if (!tried)
        TryPair(a, b);
      else if (params_.target_charts > 0 || bound_ < kNoBound || key < 0)
        AcceptPair(a, b);
    }
  }

  std::vector<int> Owners() const {
    std::vector<int> owner(parts_->Count());
    for (int c = 0; c < static_cast<int>(charts_.size()); ++c)
      if (charts_[c].alive)
        for (int part : charts_[c].parts) owner[part] = c;
    return owner;
  }

  void FindBorders() {
    const std::vector<int> owner = Owners();
    for (Chart& chart : charts_) chart.borders.clear();
    for (int p = 0; p < parts_->Count(); ++p)
      for (const auto& [q, length] : parts_->Borders(p))
        if (owner[p] != owner[q]) charts_[owner[p]].borders[owner[q]] += length;
  }

  void StartQueue() {
    queue_ = {};
    FindBorders();
    std::vector<std::vector<int>> untried;
    for (int a = 0; a < static_cast<int>(charts_.size()); ++a)
      for (const auto& [b, length] : charts_[a].borders)
        if (a < b && !unions_[{a, b}].tried) untried.push_back(PartsOfBoth(a, b));
    TryAll(untried);
    for (int a = 0; a < static_cast<int>(charts_.size()); ++a)
      for (const auto& [b, length] : charts_[a].borders)
        if (a < b && !unions_[{a, b}].tried) Record(a, b);
    for (int a = 0; a < static_cast<int>(charts_.size()); ++a)
      for (const auto& [b, length] : charts_[a].borders)
        if (a < b) Push(a, b);
  }

  void Record(int a, int b) {
    Union& both = unions_[{a, b}];
    both.tried = true;
    both.trial = Trial(PartsOfBoth(a, b));
    if (both.trial.flat) both.least_energy = both.trial.energy * (charts_[a].area + charts_[b].area);
  }

  void TryPair(int a, int b) {
    Record(a, b);
    Push(a, b);
  }

  // Queues a pair under what its merge costs, or costs at least, unless it is out of the question.
  void Push(int a, int b) {
    const Union& both = unions_[{a, b}];
    if (both.refused || (both.tried && !both.trial.flat)) return;
    if (!apart_.empty() && !MayStandTogether(PartsOfBoth(a, b))) return;
    double saved = charts_[a].borders[b];
    if (both.tried)
      saved -= CutLength(both.trial) - CutLength(charts_[a].trial) - CutLength(charts_[b].trial);
    const double key = both.least_energy - Energy(a) - Energy(b) - SeamCost(saved);
    // A tiny chart is hard to place once the charts around it are large: it comes first.
    constexpr double kTiny = 0.003;
    const bool later = std::min(charts_[a].area, charts_[b].area) > kTiny;
    queue_.push({later, key, a, b, both.tried});
  }

  void AcceptPair(int a, int b) {
    Union& both = unions_[{a, b}];
    // Near the bound the coarse chart doesn't tell.
    constexpr double kClearlyWithin = 0.5;
    if (both.trial.stretch - 1 > kClearlyWithin * (bound_ - 1) &&
        !TryChart(parts_->FinePatch(PartsOfBoth(a, b)), bound_, Poll()).flat) {
      both.refused = true;
      return;
    }
    const int n = Join(a, b, both.trial);
    for (int x : {a, b})
      for (const auto& [c, length] : charts_[x].borders)
        if (c != a && c != b) charts_[n].borders[c] += length;
    for (const auto& [c, length] : charts_[n].borders) {
      charts_[c].borders.erase(a);
      charts_[c].borders.erase(b);
      charts_[c].borders[n] = length;
      // Least energies are superadditive: E(abc) >= E(ac) + E(b).
      double& least = unions_[{c, n}].least_energy;
      least = Energy(n) + Energy(c);
      for (const auto& [x, other] : {std::pair{a, b}, std::pair{b, a}}) {
        const auto known = unions_.find({std::min(c, x), std::max(c, x)});
        if (known != unions_.end()) least = std::max(least, known->second.least_energy + Energy(other));
      }
      Push(c, n);
    }
  }

  int Join(int a, int b, const ChartTrial& trial) {
    Chart merged = Made(PartsOfBoth(a, b));
    merged.trial = trial;
    merged.first = a;
    merged.second = b;
    charts_.push_back(std::move(merged));
    charts_[a].alive = charts_[b].alive = false;
    --alive_;
    return static_cast<int>(charts_.size()) - 1;
  }

  // A chart that doesn't hold on the fine surface, and parts that overlap each other in it.
  struct Failure {
    int chart;
    std::set<std::pair<int, int>> overlaps;
  };

  // Checks all new charts on the fine surface; returns those that fail.
  std::vector<Failure> Unfit() {
    std::vector<int> unverified;
    std::vector<ChartPatch> patches;
    for (int c = 0; c < static_cast<int>(charts_.size()); ++c) {
      if (!charts_[c].alive || charts_[c].verified) continue;
      unverified.push_back(c);
      patches.push_back(parts_->FinePatch(charts_[c].parts));
    }
    constexpr size_t kMostOverlaps = 1000;
    std::vector<Flattening> flat(patches.size());
    std::vector<std::vector<std::pair<int, int>>> overlaps(patches.size());
    ParallelFor(static_cast<int>(patches.size()), progress_, [&](int k, const std::function<void()>& poll) {
      double cut_length = 0;
      patches[k] = Opened(patches[k], cut_length);
      FlattenOptions options;
      options.l2_bound = Bound();
      flat[k] = Flatten(patches[k].mesh, options, poll);
      if (flat[k].ok)
        overlaps[k] = OverlappingPairs(OnGrid(flat[k].uv, patches[k].mesh.triangles), kMostOverlaps);
    });
    std::vector<Failure> failures;
    for (size_t k = 0; k < unverified.size(); ++k) {
      Chart& chart = charts_[unverified[k]];
      chart.verified = flat[k].ok && flat[k].l2_stretch <= bound_ && overlaps[k].empty();
      if (chart.verified) {
        known_->Add(patches[k], std::move(flat[k]));
        continue;
      }
      failures.push_back({unverified[k], {}});
      for (const auto& [i, j] : overlaps[k]) {
        const int p = parts_->PartOf(patches[k].faces[i]), q = parts_->PartOf(patches[k].faces[j]);
        if (p != q) failures.back().overlaps.insert({std::min(p, q), std::max(p, q)});
      }
    }
    return failures;
  }

  // Parts that overlapped in one chart are not to come together again; for other failures the last merge is
  // taken back.
  bool UndoBadMerges() {
    const std::vector<Failure> failures = Unfit();
    for (const Failure& failure : failures) {
      apart_.insert(failure.overlaps.begin(), failure.overlaps.end());
      if (failure.overlaps.empty()) {
        const Chart& chart = charts_[failure.chart];
        unions_[{chart.first, chart.second}].refused = true;
      }
      std::vector<int> stack{failure.chart};
      while (!stack.empty()) {
        const int c = stack.back();
        stack.pop_back();
        if (c != failure.chart && MayStandTogether(charts_[c].parts)) {
          charts_[c].alive = true;
          ++alive_;
          continue;
        }
        if (c == failure.chart) --alive_;
        charts_[c].alive = false;
        stack.push_back(charts_[c].second);
        stack.push_back(charts_[c].first);
      }
    }
    return !failures.empty();
  }

  bool MayStandTogether(const std::vector<int>& some) const {
    return std::none_of(apart_.begin(), apart_.end(), [&](const std::pair<int, int>& pair) {
      return std::binary_search(some.begin(), some.end(), pair.first) &&
             std::binary_search(some.begin(), some.end(), pair.second);
    });
  }

  // Pairs that are above the bound together, but not with a dart or two that are shorter than their border.
  void MergeWithDarts() {
    constexpr double kWorthTrying = 1.4;
    std::set<std::pair<int, int>> failed;
    while (MayMergeMore()) {
      FindBorders();
      std::vector<std::tuple<double, int, int>> pairs;
      for (int a = 0; a < static_cast<int>(charts_.size()); ++a)
        for (const auto& [b, length] : charts_[a].borders) {
          if (a > b || !MayStandTogether(PartsOfBoth(a, b)) || failed.count({a, b}) > 0) continue;
          Union& both = unions_[{a, b}];
          if (!both.tried) Record(a, b);
          if (both.trial.stretch > 0 && both.trial.stretch < kWorthTrying)
            pairs.push_back({both.trial.stretch, a, b});
        }
      std::sort(pairs.begin(), pairs.end());
      bool merged = false;
      for (const auto& [stretch, a, b] : pairs) {
        if (!FlatWithDarts(a, b)) {
          failed.insert({a, b});
          continue;
        }
        charts_[Join(a, b, unions_[{a, b}].trial)].verified = true;
        merged = true;
        break;
      }
      if (!merged) return;
    }
  }

  bool FlatWithDarts(int a, int b) {
    const std::vector<int> both = PartsOfBoth(a, b);
    for (const bool coarse : {true, false}) {
      double cut_length = 0;
      const ChartPatch open =
          Opened(coarse ? parts_->CoarsePatch(both) : parts_->FinePatch(both), cut_length);
      DartGoal goal;
      goal.l2_stretch = coarse ? CoarseBound() : bound_;
      goal.linf_stretch = kNoBound;
      goal.longest = params_.max_dart_percent / 100 * open.Diagonal();
      goal.most_length = charts_[a].borders[b] * parts_->Unit();
      const DartedChart darted = CutStretchDarts(open, nullptr, goal, Poll());
      if (!darted.flat.ok || darted.flat.l2_stretch > goal.l2_stretch) return false;
      if (!OverlappingPairs(OnGrid(darted.flat.uv, darted.patch.mesh.triangles), 1).empty()) return false;
    }
    return true;
  }

  // Greedy merging ends where no merge helps, other steps still do. When the result doesn't hold on the fine
  // surface, all stays as it was.
  void Improve() {
    const std::vector<Chart> before = charts_;
    std::vector<int> owner = Owners();
    constexpr int kMostSteps = 20;
    bool any = false;
    for (int step = 0; step < kMostSteps; ++step) {
      const bool moved = MoveGroups(before, owner);
      const bool swapped = params_.target_charts > 0 && MergeAndSplit(before, owner);
      if (!moved && !swapped) break;
      any = true;
    }
    if (any && !Unfit().empty()) charts_ = before;
  }

  // Groups of parts that were charts once go from a chart to a neighbour where that lowers the cost.
  bool MoveGroups(const std::vector<Chart>& groups, std::vector<int>& owner) {
    std::vector<std::tuple<double, int, int>> moves;  // seam lost, group, a part of the other chart
    for (int group = 0; group < static_cast<int>(groups.size()); ++group) {
      std::map<int, int> others;  // chart: a part of it
      for (int p : groups[group].parts)
        for (const auto& border : parts_->Borders(p)) others.emplace(owner[border.first], border.first);
      for (const auto& [b, q] : others)
        if (IsMovable(groups[group].parts, b, owner))
          moves.push_back({-SeamSaved(groups[group].parts, b, owner), group, q});
    }
    std::sort(moves.begin(), moves.end());
    bool moved = false;
    for (const auto& [lost, group, q] : moves) moved |= MoveGroup(groups[group].parts, owner[q], owner);
    return moved;
  }

  // Two charts are merged and another is split, where that lowers the cost.
  bool MergeAndSplit(const std::vector<Chart>& groups, std::vector<int>& owner) {
    FindBorders();
    using Step = std::tuple<double, int, int>;  // cost, charts or chart and group
    std::vector<Step> merges, splits;
    for (int a = 0; a < static_cast<int>(charts_.size()); ++a) {
      for (const auto& [b, length] : charts_[a].borders) {
        if (a > b || !MayStandTogether(PartsOfBoth(a, b))) continue;
        const ChartTrial& both = Trial(PartsOfBoth(a, b));
        if (!both.flat) continue;
        const double cut = CutLength(both) - CutLength(charts_[a].trial) - CutLength(charts_[b].trial);
        merges.push_back({both.energy * (charts_[a].area + charts_[b].area) - Energy(a) - Energy(b) -
                              SeamCost(length - cut),
                          a, b});
      }
    }
    for (int group = 0; group < static_cast<int>(groups.size()); ++group) {
      const std::vector<int>& some = groups[group].parts;
      const int c = owner[some.front()];
      if (!IsMovable(some, -1, owner)) continue;
      const std::vector<int> rest = Without(charts_[c].parts, some);
      if (!HangTogether(rest)) continue;
      const ChartTrial &one = Trial(some), &other = Trial(rest);
      if (!one.flat || !other.flat) continue;
      const double cut = CutLength(one) + CutLength(other) - CutLength(charts_[c].trial);
      splits.push_back({one.energy * groups[group].area +
                            other.energy * (charts_[c].area - groups[group].area) - Energy(c) +
                            SeamCost(cut - SeamSaved(some, -1, owner)),
                        c, group});
    }
    std::sort(merges.begin(), merges.end());
    std::sort(splits.begin(), splits.end());
    constexpr double kGain = 1e-5;
    double best = -kGain;
    const Step *merge = nullptr, *split = nullptr;
    for (const Step& m : merges)
      for (const Step& s : splits) {
        const int c = std::get<1>(s);
        if (std::get<0>(m) + std::get<0>(s) >= best) break;
        if (c == std::get<1>(m) || c == std::get<2>(m)) continue;
        best = std::get<0>(m) + std::get<0>(s);
        merge = &m;
        split = &s;
      }
    if (!merge) return false;
    const auto [merge_cost, a, b] = *merge;
    const auto [split_cost, c, group] = *split;
    const std::vector<int> some = groups[group].parts;
    for (const std::vector<int>& made : {PartsOfBoth(a, b), some, Without(charts_[c].parts, some)})
      Replace(made, owner);
    charts_[a].alive = charts_[b].alive = charts_[c].alive = false;
    return true;
  }

  static std::vector<int> Without(const std::vector<int>& all, const std::vector<int>& some) {
    std::vector<int> rest;
    std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
    return rest;
  }

  // A new chart that takes the place of those its parts were in.
  void Replace(const std::vector<int>& of_parts, std::vector<int>& owner) {
    Chart chart = Made(of_parts);
    chart.trial = Trial(of_parts);
    for (int part : of_parts) owner[part] = static_cast<int>(charts_.size());
    charts_.push_back(std::move(chart));
  }

  // All of one chart, which is not `b` and has more parts.
  bool IsMovable(const std::vector<int>& group, int b, const std::vector<int>& owner) const {
    const int a = owner[group.front()];
    return a != b && charts_[a].parts.size() > group.size() &&
           std::all_of(group.begin(), group.end(), [&](int p) { return owner[p] == a; });
  }

  // By how much seams get shorter when a group of parts goes to chart b.
  double SeamSaved(const std::vector<int>& group, int b, const std::vector<int>& owner) const {
    double saved = 0;
    for (int p : group)
      for (const auto& [q, length] : parts_->Borders(p)) {
        if (owner[q] == b) saved += length;
        if (owner[q] == owner[p] && !std::binary_search(group.begin(), group.end(), q)) saved -= length;
      }
    return saved;
  }

  bool MoveGroup(const std::vector<int>& group, int b, std::vector<int>& owner) {
    constexpr double kMostLonger = 0.02, kGain = 1e-6;
    if (!IsMovable(group, b, owner)) return false;
    const int a = owner[group.front()];
    const double saved = SeamSaved(group, b, owner);
    if (saved < -kMostLonger) return false;
    const std::vector<int> rest = Without(charts_[a].parts, group), &to = charts_[b].parts;
    std::vector<int> grown;
    std::merge(to.begin(), to.end(), group.begin(), group.end(), std::back_inserter(grown));
    if (!HangTogether(rest) || !MayStandTogether(grown)) return false;
    const double before =
        Energy(a) + Energy(b) + SeamCost(CutLength(charts_[a].trial) + CutLength(charts_[b].trial));
    const auto cost = [&](const ChartTrial& trial, const std::vector<int>& some) {
      return trial.energy * Made(some).area + SeamCost(CutLength(trial));
    };
    const ChartTrial& more = Trial(grown);
    double after = cost(more, grown) - SeamCost(saved);
    if (!more.flat || after > before - kGain) return false;
    const ChartTrial& less = Trial(rest);
    after += cost(less, rest);
    if (!less.flat || after > before - kGain) return false;
    Replace(rest, owner);
    Replace(grown, owner);
    charts_[a].alive = charts_[b].alive = false;
    return true;
  }

  bool HangTogether(const std::vector<int>& some) const {
    std::set<int> left(some.begin(), some.end());
    std::vector<int> stack{some.front()};
    left.erase(some.front());
    while (!stack.empty()) {
      const int p = stack.back();
      stack.pop_back();
      for (const auto& [q, length] : parts_->Borders(p))
        if (left.erase(q) > 0) stack.push_back(q);
    }
    return left.empty();
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
  KnownFlattenings* known_ = nullptr;
  ChartParts<MeshType>* parts_ = nullptr;
  std::vector<Chart> charts_;  // each merge adds one; those that are alive are a partition of the parts
  int alive_ = 0;
  double bound_ = 0;
  std::map<std::vector<int>, std::pair<double, ChartTrial>> trials_;  // of parts: bound, trial
  std::map<std::pair<int, int>, Union> unions_;
  std::set<std::pair<int, int>> apart_;                   // parts that overlap when they are in one chart
  using Item = std::tuple<bool, double, int, int, bool>;  // not tiny, cost, charts, whether it is exact
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue_;
};

}  // namespace dcharts
