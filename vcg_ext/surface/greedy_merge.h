// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "surface/chart_groups.h"

namespace dcharts {

/// Merges the pair of neighbours first that adds the least cost: stretch less the price of the seam it saves.
template <class MeshType>
class GreedyMerger {
 public:
  explicit GreedyMerger(ChartGroups<MeshType>& groups) : groups_(groups) {}

  /// There are more charts than asked for, or no number was asked for.
  bool MayMergeMore() const {
    return groups_.params.target_charts == 0 || groups_.alive > groups_.params.target_charts;
  }

  /// Until there are as many charts as asked for or no pair is left that keeps within groups.bound; without
  /// either, until no merge lowers the cost.
  void Run() {
    StartQueue();
    while (!queue_.empty() && MayMergeMore()) {
      const auto [later, key, a, b, tried] = queue_.top();
      queue_.pop();
      if (!groups_.charts[a].alive || !groups_.charts[b].alive) continue;
      if (!tried)
        TryPair(a, b);
      else if (groups_.params.target_charts > 0 || groups_.bound < ChartGroups<MeshType>::kNoBound || key < 0)
        AcceptPair(a, b);
    }
  }

  /// The two are not to be merged.
  void Refuse(int a, int b) { groups_.refused.insert(groups_.PartsOfBoth(a, b)); }

  /// After groups.bound was raised: what exceeded it is tried again.
  void ForgetFailures() {
    for (auto& entry : unions_) entry.second.tried &= entry.second.trial.flat;
  }

 private:
  // What is known of the union of two charts.
  struct Union {
    bool tried = false;
    ChartTrial trial{};       // when tried
    double least_energy = 0;  // times area
  };

  bool MayMerge(int a, int b) const {
    return groups_.apart.empty() || groups_.MayStandTogether(groups_.PartsOfBoth(a, b));
  }

  bool IsRefused(int a, int b) const {
    return !groups_.refused.empty() && groups_.refused.count(groups_.PartsOfBoth(a, b)) > 0;
  }

  void StartQueue() {
    queue_ = {};
    groups_.FindBorders();
    std::vector<std::vector<int>> untried;
    for (int a = 0; a < static_cast<int>(groups_.charts.size()); ++a)
      for (const auto& [b, length] : groups_.charts[a].borders)
        if (a < b && !unions_[{a, b}].tried && MayMerge(a, b)) untried.push_back(groups_.PartsOfBoth(a, b));
    groups_.TryAll(untried);
    for (int a = 0; a < static_cast<int>(groups_.charts.size()); ++a)
      for (const auto& [b, length] : groups_.charts[a].borders)
        if (a < b && !unions_[{a, b}].tried && MayMerge(a, b)) Record(a, b);
    for (int a = 0; a < static_cast<int>(groups_.charts.size()); ++a)
      for (const auto& [b, length] : groups_.charts[a].borders)
        if (a < b) Push(a, b);
  }

  void Record(int a, int b) {
    Union& both = unions_[{a, b}];
    both.tried = true;
    both.trial = groups_.Trial(groups_.PartsOfBoth(a, b));
    if (both.trial.flat)
      both.least_energy = both.trial.energy * (groups_.charts[a].area + groups_.charts[b].area);
  }

  void TryPair(int a, int b) {
    Record(a, b);
    Push(a, b);
  }

  // Queues a pair under what its merge costs, or costs at least, unless it is out of the question.
  void Push(int a, int b) {
    const Union& both = unions_[{a, b}];
    if ((both.tried && !both.trial.flat) || !MayMerge(a, b) || IsRefused(a, b)) return;
    double saved = groups_.charts[a].borders[b];
    if (both.tried)
      saved -= groups_.CutLength(both.trial) - groups_.CutLength(groups_.charts[a].trial) -
               groups_.CutLength(groups_.charts[b].trial);
    const double key = both.least_energy - groups_.Energy(a) - groups_.Energy(b) - groups_.SeamCost(saved);
    // A tiny chart is hard to place once the charts around it are large: it comes first.
    const bool later = std::min(groups_.charts[a].area, groups_.charts[b].area) > groups_.TinyArea();
    queue_.push({later, key, a, b, both.tried});
  }

  void AcceptPair(int a, int b) {
    Union& both = unions_[{a, b}];
    const bool is_clear = IsClearlyWithin(both.trial);
    if (!is_clear && groups_.takes_long) CheckAhead(a, b);
    if (!is_clear && !IsFlatOnFine(groups_.PartsOfBoth(a, b))) {
      Refuse(a, b);
      return;
    }
    const int n = groups_.Join(a, b, both.trial);
    groups_.charts[n].verified = !is_clear;
    for (int x : {a, b})
      for (const auto& [c, length] : groups_.charts[x].borders)
        if (c != a && c != b) groups_.charts[n].borders[c] += length;
    for (const auto& [c, length] : groups_.charts[n].borders) {
      groups_.charts[c].borders.erase(a);
      groups_.charts[c].borders.erase(b);
      groups_.charts[c].borders[n] = length;
      // Least energies are superadditive: E(abc) >= E(ac) + E(b).
      double& least = unions_[{c, n}].least_energy;
      least = groups_.Energy(n) + groups_.Energy(c);
      for (const auto& [x, other] : {std::pair{a, b}, std::pair{b, a}}) {
        const auto known = unions_.find({std::min(c, x), std::max(c, x)});
        if (known != unions_.end())
          least = std::max(least, known->second.least_energy + groups_.Energy(other));
      }
      Push(c, n);
    }
  }

  // Near the bound the coarse chart doesn't tell.
  bool IsClearlyWithin(const ChartTrial& trial) const {
    constexpr double kClearlyWithin = 0.5;
    return !(trial.stretch - 1 > kClearlyWithin * (groups_.bound - 1));
  }

  // Together with the pairs that come next if this one fails.
  void CheckAhead(int a, int b) {
    constexpr int kFar = 8;  // in the queue
    const auto idle = static_cast<size_t>(IdleThreads());
    std::vector<std::vector<int>> next{groups_.PartsOfBoth(a, b)};
    if (idle == 0 || IsChecked(next.front())) return;
    std::vector<Item> seen;
    while (!queue_.empty() && seen.size() < kFar && next.size() <= idle) {
      seen.push_back(queue_.top());
      queue_.pop();
      const auto [later, key, c, d, tried] = seen.back();
      if (!tried || !groups_.charts[c].alive || !groups_.charts[d].alive) continue;
      std::vector<int> parts = groups_.PartsOfBoth(c, d);
      if (!IsClearlyWithin(unions_.at({c, d}).trial) && !IsChecked(parts)) next.push_back(std::move(parts));
    }
    for (const Item& item : seen) queue_.push(item);
    if (next.size() > 1)
      FirstThat(static_cast<int>(next.size()), groups_.Poll(),
                [&](int k, const std::function<void()>& poll) { return FineCheck(next[k], poll).fits; });
  }

  bool IsChecked(const std::vector<int>& parts) const {
    return groups_.fine_checks.Find(groups_.bound, parts) ||
           groups_.shared->checks.Find(groups_.bound, parts);
  }

  bool IsFlatOnFine(const std::vector<int>& some) {
    if (const auto known = groups_.fine_checks.Find(groups_.bound, some)) return *known;
    const SharedTrials::Check check = FineCheck(some, groups_.Poll());
    // Of one that overlaps, CheckedMerger asks which parts do.
    if (!check.overlaps) groups_.fine_checks.Add(groups_.bound, some, check.fits);
    return check.fits;
  }

  SharedTrials::Check FineCheck(const std::vector<int>& some, const std::function<void()>& poll) {
    SharedTrials& shared = *groups_.shared;
    if (const auto made = shared.checks.Find(groups_.bound, some)) return *made;
    const ChartPatch patch = groups_.parts.FinePatch(some);
    TrialFlattening map;
    SharedTrials::Check check;
    check.fits = TryChart(patch, groups_.bound, poll, &map).flat;
    check.overlaps = !check.fits && map.overlaps > 0;
    shared.checks.Add(groups_.bound, some, check);
    shared.fine.Add(patch.faces, std::move(map));
    return check;
  }

  using Item = std::tuple<bool, double, int, int, bool>;  // not tiny, cost, charts, whether it is exact

  ChartGroups<MeshType>& groups_;
  std::map<std::pair<int, int>, Union> unions_;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue_;
};

}  // namespace dcharts
