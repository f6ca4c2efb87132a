// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "surface/chart_groups.h"

namespace dcharts {

/// Greedy merging ends where no merge helps; here other steps lower the cost further, the number of charts
/// staying as it is.
template <class MeshType>
class MergeImprover {
 public:
  explicit MergeImprover(ChartGroups<MeshType>& groups) : groups_(groups) {}

  /// `before`: a copy of the charts, those that were merged on the way too; they are the groups that move.
  /// Returns whether anything changed. Charts that changed have no children and are not verified.
  bool Run(const std::vector<typename ChartGroups<MeshType>::Chart>& before) {
    std::vector<int> owner = groups_.Owners();
    constexpr int kMostSteps = 20;
    bool any = false;
    for (int step = 0; step < kMostSteps; ++step) {
      const bool moved = MoveGroups(before, owner);
      const bool swapped = groups_.params.target_charts > 0 && MergeAndSplit(before, owner);
      if (!moved && !swapped) break;
      any = true;
    }
    return any;
  }

 private:
  // Groups of parts that were charts once go from a chart to a neighbour where that lowers the cost.
  bool MoveGroups(const std::vector<typename ChartGroups<MeshType>::Chart>& groups, std::vector<int>& owner) {
    std::vector<std::tuple<double, int, int>> moves;  // seam lost, group, a part of the other chart
    for (int group = 0; group < static_cast<int>(groups.size()); ++group) {
      std::map<int, int> others;  // chart: a part of it
      for (int p : groups[group].parts)
        for (const auto& border : groups_.parts.Borders(p)) others.emplace(owner[border.first], border.first);
      for (const auto& [b, q] : others)
        if (IsMovable(groups[group].parts, b, owner))
          moves.push_back({-SeamSaved(groups[group].parts, b, owner), group, q});
    }
    std::sort(moves.begin(), moves.end());
    bool moved = false;
    for (size_t k = 0; k < moves.size(); ++k) {
      // Most are refused.
      std::vector<std::vector<int>> next;
      const auto idle = static_cast<size_t>(groups_.takes_long ? IdleThreads() : 0);
      for (size_t n = k; n < moves.size() && idle > 0 && next.size() <= idle; ++n) {
        const auto& [lost, group, q] = moves[n];
        auto move = MoveOf(groups[group].parts, owner[q], owner);
        if (move && !groups_.IsTried(move->grown)) next.push_back(std::move(move->grown));
        if (n == k && next.empty()) break;
      }
      groups_.TryAhead(next);
      const auto& [lost, group, q] = moves[k];
      moved |= MoveGroup(groups[group].parts, owner[q], owner);
    }
    return moved;
  }

  // Two charts are merged and another is split, where that lowers the cost.
  bool MergeAndSplit(const std::vector<typename ChartGroups<MeshType>::Chart>& groups,
                     std::vector<int>& owner) {
    groups_.FindBorders();
    using Step = std::tuple<double, int, int>;  // cost, charts or chart and group
    std::vector<Step> merges, splits;
    for (int a = 0; a < static_cast<int>(groups_.charts.size()); ++a) {
      for (const auto& [b, length] : groups_.charts[a].borders) {
        if (a > b || !groups_.MayStandTogether(groups_.PartsOfBoth(a, b))) continue;
        const ChartTrial& both = groups_.Trial(groups_.PartsOfBoth(a, b));
        if (!both.flat) continue;
        const double cut = groups_.CutLength(both) - groups_.CutLength(groups_.charts[a].trial) -
                           groups_.CutLength(groups_.charts[b].trial);
        merges.push_back({both.energy * (groups_.charts[a].area + groups_.charts[b].area) -
                              groups_.Energy(a) - groups_.Energy(b) - groups_.SeamCost(length - cut),
                          a, b});
      }
    }
    if (merges.empty()) return false;
    std::sort(merges.begin(), merges.end());
    constexpr double kGain = 1e-5;
    for (int group = 0; group < static_cast<int>(groups.size()); ++group) {
      const std::vector<int>& some = groups[group].parts;
      const int c = owner[some.front()];
      const double area = groups[group].area, other_area = groups_.charts[c].area - area;
      if (!IsMovable(some, -1, owner) || std::min(area, other_area) < groups_.TinyArea()) continue;
      // Most seams are too long for what could be gained, if both sides had no stretch at all.
      const double least =
          groups_.SeamCost(-SeamSaved(some, -1, owner) - groups_.CutLength(groups_.charts[c].trial)) -
          groups_.Energy(c);
      if (std::get<0>(merges.front()) + least >= -kGain) continue;
      const std::vector<int> rest = Without(groups_.charts[c].parts, some);
      if (!groups_.HangTogether(rest)) continue;
      const ChartTrial& one = groups_.Trial(some);
      if (!one.flat || std::get<0>(merges.front()) + least + one.energy * area >= -kGain) continue;
      const ChartTrial& other = groups_.Trial(rest);
      if (!other.flat) continue;
      const double cut =
          groups_.CutLength(one) + groups_.CutLength(other) - groups_.CutLength(groups_.charts[c].trial);
      splits.push_back({one.energy * area + other.energy * other_area - groups_.Energy(c) +
                            groups_.SeamCost(cut - SeamSaved(some, -1, owner)),
                        c, group});
    }
    std::sort(splits.begin(), splits.end());
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
    for (const std::vector<int>& made :
         {groups_.PartsOfBoth(a, b), some, Without(groups_.charts[c].parts, some)})
      groups_.Replace(made, owner);
    groups_.charts[a].alive = groups_.charts[b].alive = groups_.charts[c].alive = false;
    return true;
  }

  static std::vector<int> Without(const std::vector<int>& all, const std::vector<int>& some) {
    std::vector<int> rest;
    std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
    return rest;
  }

  // All of one chart, which is not `b` and has more parts.
  bool IsMovable(const std::vector<int>& group, int b, const std::vector<int>& owner) const {
    const int a = owner[group.front()];
    return a != b && groups_.charts[a].parts.size() > group.size() &&
           std::all_of(group.begin(), group.end(), [&](int p) { return owner[p] == a; });
  }

  // By how much seams get shorter when a group of parts goes to chart b.
  double SeamSaved(const std::vector<int>& group, int b, const std::vector<int>& owner) const {
    double saved = 0;
    for (int p : group)
      for (const auto& [q, length] : groups_.parts.Borders(p)) {
        if (owner[q] == b) saved += length;
        if (owner[q] == owner[p] && !std::binary_search(group.begin(), group.end(), q)) saved -= length;
      }
    return saved;
  }

  // Of a group from one chart to another: the parts that both have then, and by how much seams get shorter.
  struct Move {
    std::vector<int> rest, grown;
    double saved;
  };

  // To chart b; none where no trial is needed to tell that the group can't go there.
  std::optional<Move> MoveOf(const std::vector<int>& group, int b, const std::vector<int>& owner) const {
    constexpr double kMostLonger = 0.02;
    if (!IsMovable(group, b, owner)) return std::nullopt;
    const auto& chart = groups_.charts[owner[group.front()]];
    const double saved = SeamSaved(group, b, owner);
    if (saved < -kMostLonger || chart.area - groups_.AreaOf(group) < groups_.TinyArea()) return std::nullopt;
    Move move{Without(chart.parts, group), ChartGroups<MeshType>::Joined(groups_.charts[b].parts, group),
              saved};
    if (!groups_.HangTogether(move.rest) || !groups_.MayStandTogether(move.grown)) return std::nullopt;
    return move;
  }

  bool MoveGroup(const std::vector<int>& group, int b, std::vector<int>& owner) {
    constexpr double kGain = 1e-6;
    const std::optional<Move> move = MoveOf(group, b, owner);
    if (!move) return false;
    const int a = owner[group.front()];
    const auto& [rest, grown, saved] = *move;
    const double before = groups_.Energy(a) + groups_.Energy(b) +
                          groups_.SeamCost(groups_.CutLength(groups_.charts[a].trial) +
                                           groups_.CutLength(groups_.charts[b].trial));
    const auto cost = [&](const ChartTrial& trial, const std::vector<int>& some) {
      return trial.energy * groups_.AreaOf(some) + groups_.SeamCost(groups_.CutLength(trial));
    };
    const ChartTrial& more = groups_.Trial(grown);
    double after = cost(more, grown) - groups_.SeamCost(saved);
    if (!more.flat || after > before - kGain) return false;
    const ChartTrial& less = groups_.Trial(rest);
    after += cost(less, rest);
    if (!less.flat || after > before - kGain) return false;
    groups_.Replace(rest, owner);
    groups_.Replace(grown, owner);
    groups_.charts[a].alive = groups_.charts[b].alive = false;
    return true;
  }

  ChartGroups<MeshType>& groups_;
};

}  // namespace dcharts
