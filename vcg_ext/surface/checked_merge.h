// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <map>
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

  /// With most effort a pair gets more darts, and is drawn apart where it laps over itself.
  enum class Effort { kUsual, kMost };

  /// There are more charts than asked for, or no number was asked for.
  bool MayMergeMore() const { return greedy_.MayMergeMore(); }
  int MergesWithDarts() const { return merges_with_darts_; }

  /// What Merge() begins with: nothing is checked yet.
  void MergeUnchecked(double bound) {
    groups_.bound = bound;
    greedy_.ForgetFailures();
    greedy_.Run();
  }

  /// Merges until done, then has all charts checked on the fine surface; those that fail there are taken
  /// apart, and merging goes on with other pairs.
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

  /// Pairs that are above the bound together, but not with some darts, if seams don't get longer by that.
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

  /// Charts that can be given away in pieces, the smallest first; of many, large ones find no room.
  void Dissolve() {
    constexpr int kMany = 8;  // charts
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

  /// See MergeImprover. What doesn't hold on the fine surface is not made again.
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

 private:
  static constexpr double kNoBound = ChartGroups<MeshType>::kNoBound;
  static constexpr double kWorthTrying = 1.4;  // the L2 stretch without darts

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
    for (int c = 0; c < static_cast<int>(groups_.charts.size()); ++c) {
      auto& chart = groups_.charts[c];
      if (!chart.alive || chart.verified) continue;
      if (const auto known = groups_.fine_checks.Find(groups_.bound, chart.parts)) {
        chart.verified = *known;
        if (!*known) failures.push_back({c, {}});
        continue;
      }
      unverified.push_back(c);
    }
    const std::vector<SharedTrials::Map> maps = MapsOf(unverified);
    for (size_t k = 0; k < unverified.size(); ++k) {
      auto& chart = groups_.charts[unverified[k]];
      chart.verified = maps[k].fits;
      if (maps[k].fits || maps[k].overlaps.empty())
        groups_.fine_checks.Add(groups_.bound, chart.parts, maps[k].fits);
      if (!maps[k].fits) failures.push_back({unverified[k], maps[k].overlaps});
    }
    std::sort(failures.begin(), failures.end(),
              [](const Failure& a, const Failure& b) { return a.chart < b.chart; });
    return failures;
  }

  // Of these charts on the fine surface.
  std::vector<SharedTrials::Map> MapsOf(const std::vector<int>& charts) {
    SharedTrials& shared = *groups_.shared;
    std::vector<SharedTrials::Map> maps(charts.size());
    std::vector<size_t> open;
    std::vector<ChartPatch> patches;
    for (size_t k = 0; k < charts.size(); ++k) {
      const std::vector<int>& parts = groups_.charts[charts[k]].parts;
      if (const auto made = shared.maps.Find(groups_.bound, parts)) {
        maps[k] = *made;
        continue;
      }
      open.push_back(k);
      patches.push_back(groups_.parts.FinePatch(parts));
    }
    ParallelForLargestFirst(
        static_cast<int>(open.size()), groups_.progress, [&](int k) { return patches[k].faces.size(); },
        [&](int k, const std::function<void()>& poll) {
          SharedTrials::Map& map = maps[open[k]];
          map = FineMap(patches[k], poll);
          shared.maps.Add(groups_.bound, groups_.charts[charts[open[k]]].parts, map);
        });
    return maps;
  }

  SharedTrials::Map FineMap(const ChartPatch& patch, const std::function<void()>& poll) {
    constexpr size_t kMostOverlaps = 1000;
    double cut_length = 0;
    const ChartPatch open = Opened(patch, cut_length);
    TrialOptions options;
    options.l2_bound = groups_.bound;
    TrialFlattening flat = TrialFlatten(open.mesh, options, poll);
    SharedTrials::Map map;
    if (!flat.ok) return map;
    const auto overlaps = OverlapsInMap(flat.uv, open.mesh.triangles, kMostOverlaps);
    map.fits = overlaps.empty();
    if (map.fits) groups_.shared->fine.Add(patch.faces, std::move(flat));
    for (const auto& [i, j] : overlaps) {
      const int p = groups_.parts.PartOfFine(patch.faces[i]), q = groups_.parts.PartOfFine(patch.faces[j]);
      if (p != q) map.overlaps.insert({std::min(p, q), std::max(p, q)});
    }
    return map;
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
      goal.is_trial = !coarse && !known_;
      goal.longest = groups_.params.max_dart_percent / 100 * result.open.Diagonal();
      // No bound on the length here: Cut has none and is to find the same darts.
      KnownOfChart uncut;
      Flattening flat;
      if (!coarse && known_ && !IsLargeChart(result.open.mesh)) {
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
    return coarse ? groups_.parts.CoarsePatch(parts) : groups_.parts.FinePatch(parts);
  }

  // Cut looks for the darts of a copy's chart anew, on the surface, and may come out a little worse.
  double BoundWithDarts() const {
    constexpr double kShareOnCopy = 0.85;
    return known_ ? groups_.bound : 1 + kShareOnCopy * (groups_.bound - 1);
  }

  // BorderRefiner begins with it too.
  TrialFlattening FineTrial(const ChartPatch& whole, const ChartPatch& open,
                            const std::function<void()>& poll) {
    if (const TrialFlattening* known = groups_.shared->fine.Find(whole.faces)) return *known;
    TrialFlattening trial = TrialFlatten(open.mesh, {}, poll);
    groups_.shared->fine.Add(whole.faces, trial);
    return trial;
  }

  ChartGroups<MeshType>& groups_;
  KnownFlattenings* const known_;
  GreedyMerger<MeshType> greedy_;
  int merges_with_darts_ = 0;
};

}  // namespace dcharts
