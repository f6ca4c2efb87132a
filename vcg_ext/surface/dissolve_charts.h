// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "surface/chart_groups.h"

namespace dcharts {

/// Where no two charts may be merged whole, one can often still be given away in pieces to its neighbours.
/// Greedy merging ends with a number of charts that hangs on chance; this takes most of the chance out.
template <class MeshType>
class ChartDissolver {
 public:
  explicit ChartDissolver(ChartGroups<MeshType>& groups) : groups_(groups) {}

  /// Looks for neighbours that take the chart's groups, as large as they can be, and stay within
  /// groups.bound. Returns false when some have no place.
  bool FindPlaces(int chart) {
    owner_ = groups_.Owners();
    chart_ = chart;
    grown_.clear();
    std::vector<std::vector<int>> homeless{groups_.charts[chart].parts};
    while (!homeless.empty()) {
      std::vector<std::vector<int>> waiting;
      for (const std::vector<int>& group : homeless)
        if (!Place(group)) waiting.push_back(group);
      if (waiting.size() == homeless.size()) {
        homeless.clear();
        for (const std::vector<int>& group : waiting) Divide(group, homeless);
        if (homeless.size() == waiting.size()) return false;
      } else {
        homeless = std::move(waiting);
      }
    }
    return true;
  }

  /// Gives them away. Charts that grow have no children and are not verified.
  void Apply() {
    for (const auto& [c, parts] : grown_) {
      groups_.charts[c].alive = false;
      groups_.Replace(parts, owner_);
    }
    groups_.charts[chart_].alive = false;
    --groups_.alive;
  }

 private:
  // To the neighbour where it costs least.
  bool Place(const std::vector<int>& group) {
    std::map<int, double> borders;
    for (int p : group)
      for (const auto& [q, length] : groups_.parts.Borders(p))
        if (owner_[q] != chart_) borders[owner_[q]] += length;
    const auto with = [&](int b) { return ChartGroups<MeshType>::Joined(PartsOf(b), group); };
    std::vector<std::vector<int>> unions;
    for (const auto& [b, length] : borders)
      if (std::vector<int> both = with(b); groups_.MayStandTogether(both)) unions.push_back(std::move(both));
    groups_.TryAll(unions);
    const double own = groups_.AreaOf(group);
    double least = ChartGroups<MeshType>::kNoBound;
    int home = -1;
    for (const auto& [b, length] : borders) {
      const std::vector<int>&now = PartsOf(b), both = with(b);
      if (!groups_.MayStandTogether(both)) continue;
      const ChartTrial& trial = groups_.Trial(both);
      if (!trial.flat) continue;
      const double area = groups_.AreaOf(now);
      const ChartTrial& before = groups_.Trial(now);
      const double cost = trial.energy * (area + own) - before.energy * area -
                          groups_.SeamCost(length - groups_.CutLength(trial) + groups_.CutLength(before));
      if (cost >= least) continue;
      least = cost;
      home = b;
    }
    if (home < 0) return false;
    grown_[home] = ChartGroups<MeshType>::Joined(PartsOf(home), group);
    for (int p : group) owner_[p] = home;
    return true;
  }

  const std::vector<int>& PartsOf(int c) const {
    const auto grown = grown_.find(c);
    return grown == grown_.end() ? groups_.charts[c].parts : grown->second;
  }

  // Into the two it was merged from, or into single parts.
  void Divide(const std::vector<int>& group, std::vector<std::vector<int>>& into) const {
    for (const auto& chart : groups_.charts)
      if (chart.first >= 0 && chart.parts == group) {
        into.push_back(groups_.charts[chart.first].parts);
        into.push_back(groups_.charts[chart.second].parts);
        return;
      }
    for (int p : group) into.push_back({p});
  }

  ChartGroups<MeshType>& groups_;
  int chart_ = -1;
  std::vector<int> owner_;
  std::map<int, std::vector<int>> grown_;  // charts that got something: all their parts
};

}  // namespace dcharts
