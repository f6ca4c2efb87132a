// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "planar/lay_apart.h"
#include "planar/overlap.h"
#include "planar/trial_flatten.h"
#include "surface/chart_groups.h"
#include "surface/dissolve_charts.h"
#include "surface/greedy_merge.h"
#include "surface/known_flattenings.h"
#include "surface/merge_improvement.h"
#include "surface/stretch_darts.h"

namespace dcharts {

/// Merges charts by trials on the coarse surface and checks what comes of it on the fine one.
template <class MeshType>
class CheckedMerger {
 public:
  /// Darts that were found on the surface itself are left in `known`, if that isn't null.
  CheckedMerger(ChartGroups<MeshType>& groups, KnownFlattenings* known)
      : groups_(groups), known_(known), greedy_(groups) {}

  void Run() {
    const double bound = groups_.params.StretchBound();
    const bool to_fewest = groups_.params.target_charts == 0 && bound < kNoBound;
    Merge(bound);
    if (bound < kNoBound) MergeWithDarts(Effort::kUsual);
    if (to_fewest) {
      Dissolve();
      if (MayBeTooMany() || MayNeedFewerDarts()) MergeAgain(bound);
      if (IsWorthMostEffort()) MergeWithDarts(Effort::kMost);
    }
    if (groups_.params.target_charts > 0 && greedy_.MayMergeMore()) Merge(kNoBound);
    Improve();
  }

 private:
  static constexpr double kNoBound = ChartGroups<MeshType>::kNoBound;
  static constexpr int kFew = 3, kMany = 8;    // charts
  static constexpr double kWorthTrying = 1.4;  // the L2 stretch without darts

  // With most effort a pair gets more darts, and is drawn apart where it laps over itself.
  enum class Effort { kUsual, kMost };

  // Merges until done, then has all charts checked on the fine surface; those that fail there are taken
  // apart, and merging goes on with other pairs.
  void Merge(double bound) {
    groups_.bound = bound;
    greedy_.ForgetFailures();
    constexpr int kRounds = 12;
    for (int round = 0; round < kRounds; ++round) {
      greedy_.Run();
      if (UndoBadMerges()) continue;
      // Of the few pairs that are left, those too that were not tried.
      if (!groups_.overlaps_stay || groups_.overlapping.empty()) break;
      groups_.overlaps_stay = false;
      greedy_.ForgetFailures();
    }
    groups_.overlaps_stay = true;
  }

  // One chart is a large share of so many, and another order often saves it. Of more it seldom saves any, and
  // small ones, ends of limbs, stay in any order.
  bool MayBeTooMany() const {
    constexpr double kSmall = 0.015;
    constexpr int kEnough = 6;
    int count = 0;
    for (const auto& chart : groups_.charts) count += chart.alive && chart.area > kSmall;
    return count > kFew && count <= kEnough;
  }

  // In another order, merges that needed darts may not be made. Where few charts are left, one that did is
  // not too many.
  bool MayNeedFewerDarts() const { return merges_with_darts_ > (groups_.alive <= kFew ? 1 : 0); }

  // What each try costs is little beside what one chart of a few is worth.
  bool IsWorthMostEffort() const {
    return groups_.alive > kFew && groups_.alive <= kMany &&
           groups_.params.method == FlattenMethod::kStretchMinimizing;
  }

  // In another order; kept where that ends with fewer charts, or with as many and shorter seams.
  void MergeAgain(double bound) {
    constexpr double kShare = 0.2;
    const auto charts = groups_.charts;
    const int alive = groups_.alive;
    const double seams = groups_.SeamLength();
    groups_.TakeApart();
    greedy_.Restart();
    groups_.seam_share = kShare;
    Merge(bound);
    Dissolve();
    groups_.seam_share = 1;
    if (merges_with_darts_ > 0 || groups_.alive < alive) {
      MergeWithDarts(Effort::kUsual);
      Dissolve();
    }
    if (std::make_pair(groups_.alive, groups_.SeamLength()) >= std::make_pair(alive, seams)) {
      groups_.charts = charts;
      groups_.alive = alive;
    }
  }

  // Charts that can be given away in pieces, the smallest first; of many, large ones find no room.
  void Dissolve() {
    for (bool again = true; again;) {
      again = false;
      std::vector<std::pair<double, int>> order;
      for (int c = 0; c < static_cast<int>(groups_.charts.size()); ++c)
        if (groups_.charts[c].alive) order.push_back({groups_.charts[c].area, c});
      std::sort(order.begin(), order.end());
      for (const auto& [area, c] : order) {
        if (groups_.alive > kMany && area * groups_.alive > 1) break;
        if (groups_.charts[c].alive) again |= DissolveChart(c);
      }
    }
  }

  // What doesn't hold on the fine surface is not made again.
  bool DissolveChart(int c) {
    ChartDissolver<MeshType> dissolver(groups_);
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds && dissolver.FindPlaces(c); ++round) {
      const auto before = groups_.charts;
      dissolver.Apply();
      const std::vector<Failure> failures = Unfit();
      if (failures.empty()) return true;
      Forbid(failures);
      groups_.charts = before;
      ++groups_.alive;
    }
    return false;
  }

  // What doesn't hold on the fine surface is not made again.
  void Improve() {
    const auto before = groups_.charts;
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
      if (!MergeImprover<MeshType>(groups_).Run(before)) return;
      const std::vector<Failure> failures = Unfit();
      if (failures.empty()) return;
      Forbid(failures);
      groups_.charts = before;
    }
  }

  // A chart that doesn't hold on the fine surface, and parts that overlap each other in it.
  struct Failure {
    int chart;
    std::set<std::pair<int, int>> overlaps;
  };

  void Forbid(const std::vector<Failure>& failures) {
    for (const Failure& failure : failures) {
      groups_.apart.insert(failure.overlaps.begin(), failure.overlaps.end());
      groups_.Forbid(groups_.charts[failure.chart].parts);
    }
  }

  // Checks all new charts on the fine surface; returns those that fail.
  std::vector<Failure> Unfit() {
    std::vector<Failure> failures;
    std::vector<int> unverified;
    std::vector<ChartPatch> patches;
    for (int c = 0; c < static_cast<int>(groups_.charts.size()); ++c) {
      auto& chart = groups_.charts[c];
      if (!chart.alive || chart.verified) continue;
      if (const auto known = groups_.fine_checks.Find(groups_.bound, chart.parts)) {
        chart.verified = *known;
        if (!*known) failures.push_back({c, {}});
        continue;
      }
      unverified.push_back(c);
      patches.push_back(groups_.parts.FinePatch(chart.parts));
    }
    constexpr size_t kMostOverlaps = 1000;
    std::vector<char> fits(patches.size());
    std::vector<TrialFlattening> flat(patches.size());
    std::vector<std::vector<std::pair<int, int>>> overlaps(patches.size());
    ParallelForLargestFirst(
        static_cast<int>(patches.size()), groups_.progress, [&](int k) { return patches[k].faces.size(); },
        [&](int k, const std::function<void()>& poll) {
          double cut_length = 0;
          const ChartPatch open = Opened(patches[k], cut_length);
          TrialOptions options;
          options.l2_bound = groups_.bound;
          flat[k] = TrialFlatten(open.mesh, options, poll);
          if (flat[k].ok) overlaps[k] = OverlapsInMap(flat[k].uv, open.mesh.triangles, kMostOverlaps);
          fits[k] = flat[k].ok && overlaps[k].empty();
        });
    for (size_t k = 0; k < unverified.size(); ++k) {
      auto& chart = groups_.charts[unverified[k]];
      chart.verified = fits[k];
      if (fits[k] || overlaps[k].empty()) groups_.fine_checks.Add(groups_.bound, chart.parts, fits[k]);
      if (fits[k]) {
        groups_.fine_trials.Add(patches[k].faces, std::move(flat[k]));
        continue;
      }
      failures.push_back({unverified[k], {}});
      for (const auto& [i, j] : overlaps[k]) {
        const int p = groups_.parts.PartOfFine(patches[k].faces[i]),
                  q = groups_.parts.PartOfFine(patches[k].faces[j]);
        if (p != q) failures.back().overlaps.insert({std::min(p, q), std::max(p, q)});
      }
    }
    std::sort(failures.begin(), failures.end(),
              [](const Failure& a, const Failure& b) { return a.chart < b.chart; });
    return failures;
  }

  // Parts that overlapped in one chart are not to come together again; for other failures the last merge is
  // taken back.
  bool UndoBadMerges() {
    const std::vector<Failure> failures = Unfit();
    for (const Failure& failure : failures) {
      groups_.apart.insert(failure.overlaps.begin(), failure.overlaps.end());
      if (failure.overlaps.empty()) {
        const auto& chart = groups_.charts[failure.chart];
        greedy_.Refuse(chart.first, chart.second);
      }
      std::vector<int> stack{failure.chart};
      while (!stack.empty()) {
        const int c = stack.back();
        stack.pop_back();
        if (c != failure.chart && groups_.MayStandTogether(groups_.charts[c].parts)) {
          groups_.charts[c].alive = true;
          ++groups_.alive;
          continue;
        }
        if (c == failure.chart) --groups_.alive;
        groups_.charts[c].alive = false;
        stack.push_back(groups_.charts[c].second);
        stack.push_back(groups_.charts[c].first);
      }
    }
    return !failures.empty();
  }

  // Pairs that are above the bound together, but not with some darts, if seams don't get longer by that.
  void MergeWithDarts(Effort effort) {
    std::set<std::pair<int, int>> failed;
    std::map<std::pair<int, int>, ChartTrial> trials;
    while (greedy_.MayMergeMore()) {
      groups_.FindBorders();
      TryBeforeDarts(effort, trials);
      std::vector<std::tuple<double, int, int>> pairs;
      for (int a = 0; a < static_cast<int>(groups_.charts.size()); ++a)
        for (const auto& [b, length] : groups_.charts[a].borders) {
          if (a > b || failed.count({a, b}) > 0) continue;
          const double stretch = trials.at({a, b}).stretch;
          if (stretch > 0 && stretch < kWorthTrying) pairs.push_back({stretch, a, b});
        }
      std::sort(pairs.begin(), pairs.end());
      std::vector<WithDarts> tried(pairs.size());
      const auto lies_flat = [&](int k, const std::function<void()>& poll) {
        const auto& [stretch, a, b] = pairs[k];
        tried[k] = TryWithDarts(a, b, effort, poll);
        return tried[k].lies_flat;
      };
      const int count = static_cast<int>(pairs.size());
      int first = 0;
      if (known_)
        while (first < count && !lies_flat(first, groups_.Poll())) ++first;
      else  // each takes long
        first = FirstThat(count, groups_.Poll(), lies_flat);
      for (int k = 0; k < first; ++k) failed.insert({std::get<1>(pairs[k]), std::get<2>(pairs[k])});
      if (first == count) return;
      const auto& [stretch, a, b] = pairs[first];
      ChartTrial both = trials.at({a, b});
      both.cut_length = tried[first].cut_length;
      if (known_) known_->AddDarts(tried[first].open, tried[first].goal, std::move(tried[first].darted));
      groups_.charts[groups_.Join(a, b, both)].verified = true;
      ++merges_with_darts_;
    }
  }

  // Makes the trials of neighbours that are not there, without darts. They have no stretch when the parts may
  // not come together.
  void TryBeforeDarts(Effort effort, std::map<std::pair<int, int>, ChartTrial>& trials) {
    std::vector<ChartTrial*> made;
    std::vector<ChartPatch> patches;
    for (int a = 0; a < static_cast<int>(groups_.charts.size()); ++a)
      for (const auto& [b, length] : groups_.charts[a].borders) {
        if (a > b) continue;
        const auto [at, is_new] = trials.try_emplace({a, b});
        if (!is_new) continue;
        const std::vector<int> both = groups_.PartsOfBoth(a, b);
        if (effort == Effort::kUsual) {
          if (groups_.MayStandTogether(both)) at->second = groups_.Trial(both);
        } else if (!groups_.HoldKeptBorder(both)) {
          made.push_back(&at->second);
          patches.push_back(groups_.parts.CoarsePatch(both));
        }
      }
    ParallelForLargestFirst(
        static_cast<int>(made.size()), groups_.progress, [&](int k) { return patches[k].faces.size(); },
        [&](int k, const std::function<void()>& poll) {
          *made[k] = TryChartWithOverlaps(patches[k], kWorthTrying, poll);
        });
  }

  // Its parts can be drawn apart, which must not crumple it.
  static bool ComesApart(const DartedChart& chart, double l2_bound, const std::function<void()>& poll) {
    constexpr double kWorstStretch = 1.8;
    const auto apart =
        LayApart(chart.patch.mesh, chart.flat.uv, l2_bound, ApartMapFor::kAtlas, poll, chart.coarser.get());
    return apart && apart->linf_stretch <= kWorstStretch;
  }

  // Two charts as one, with darts.
  struct WithDarts {
    bool lies_flat = false;
    double cut_length = 0;  // of all cuts, model units
    // When it does, on the copy for checks:
    ChartPatch open{};
    DartGoal goal{};
    DartedChart darted{};
  };

  WithDarts TryWithDarts(int a, int b, Effort effort, const std::function<void()>& poll) {
    constexpr int kFewDarts = 4, kManyDarts = 8;
    const std::vector<int> both = groups_.PartsOfBoth(a, b);
    const auto &one = groups_.charts[a], &other = groups_.charts[b];
    const double longest =
        one.borders.at(b) * groups_.parts.Unit() + one.trial.cut_length + other.trial.cut_length;
    WithDarts result;
    for (const bool coarse : {true, false}) {
      const ChartPatch whole = PatchOf(both, coarse);
      result.open = Opened(whole, result.cut_length);
      DartGoal& goal = result.goal;
      goal.l2_stretch = coarse ? groups_.CoarseBound() : BoundWithDarts();
      goal.linf_stretch = kNoBound;
      goal.most_darts = effort == Effort::kMost ? kManyDarts : kFewDarts;
      goal.longest = groups_.params.max_dart_percent / 100 * result.open.Diagonal();
      // No bound on the length here: Cut has none and is to find the same darts.
      KnownOfChart uncut;
      Flattening flat;
      if (!coarse && !IsLargeChart(result.open.mesh)) {
        flat = FlatOf(FineTrial(whole, result.open, poll));
        uncut.flat = &flat;
      }
      DartedChart& darted = result.darted;
      darted = CutStretchDarts(result.open, goal, poll, uncut);
      for (int h : darted.edges) result.cut_length += result.open.Length(h);
      constexpr double kRounding = 1e-6;  // darts to the corners of a box may be just as long as its rim
      if (result.cut_length > (1 + kRounding) * longest) return {};
      if (!darted.flat.ok || darted.flat.l2_stretch > goal.l2_stretch) return {};
      if (OverlapsItself(darted.flat.uv, darted.patch.mesh.triangles)) {
        if (effort == Effort::kUsual) return {};
        if (!coarse && !ComesApart(darted, goal.l2_stretch, poll)) return {};
      }
    }
    result.lies_flat = true;
    return result;
  }

  // On the copy for trials, or that for checks.
  ChartPatch PatchOf(const std::vector<int>& parts, bool coarse) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return coarse ? groups_.parts.CoarsePatch(parts) : groups_.parts.FinePatch(parts);
  }

  // Cut looks for the darts of a copy's chart anew, on the surface, and may come out a little worse.
  double BoundWithDarts() const {
    constexpr double kShareOnCopy = 0.85;
    return known_ ? groups_.bound : 1 + kShareOnCopy * (groups_.bound - 1);
  }

  // Made once: BorderRefiner begins with it too.
  TrialFlattening FineTrial(const ChartPatch& whole, const ChartPatch& open,
                            const std::function<void()>& poll) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (const TrialFlattening* known = groups_.fine_trials.Find(whole.faces)) return *known;
    }
    TrialFlattening trial = TrialFlatten(open.mesh, {}, poll);
    const std::lock_guard<std::mutex> lock(mutex_);
    groups_.fine_trials.Add(whole.faces, trial);
    return trial;
  }

  ChartGroups<MeshType>& groups_;
  KnownFlattenings* const known_;
  GreedyMerger<MeshType> greedy_;
  std::mutex mutex_;  // of the copies, and of fine_trials
  int merges_with_darts_ = 0;
};

}  // namespace dcharts
