// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/params.h"
#include "common/progress.h"
#include "surface/chart_parts.h"
#include "surface/chart_trial.h"
#include "surface/fine_checks.h"
#include "surface/seam_price.h"
#include "surface/shared_trials.h"

namespace dcharts {

/// Charts that are put together from parts, and what they cost: for a surface of area 1, the symmetric
/// Dirichlet energy (over 4, less 1) of all charts plus a price for the length of all seams. Lengths and
/// areas are those of a surface of area 1. Trials are made on the coarse copy of the surface.
template <class MeshType>
struct ChartGroups {
  struct Chart {
    std::vector<int> parts{};
    double area = 0;
    ChartTrial trial{};           // of the coarse chart
    int first = -1, second = -1;  // what it was merged from
    bool alive = true;
    bool verified = false;            // lies flat on the fine surface
    std::map<int, double> borders{};  // neighbour: length; since FindBorders()
  };

  /// `of_parts` must outlive the groups; each part is a chart at first.
  ChartGroups(ChartParts<MeshType>& of_parts, const Params& with_params, Progress& to_progress)
      : parts(of_parts),
        params(with_params),
        progress(to_progress),
        shared(std::make_shared<SharedTrials>()) {
    apart = parts.KeptApart();
    alive = parts.Count();
    std::vector<std::vector<int>> single(alive);
    for (int c = 0; c < alive; ++c) single[c] = {c};
    TryAll(single);
    for (int c = 0; c < alive; ++c) {
      charts.push_back(Made({c}));
      charts.back().verified = true;  // by SplitBadCharts
      charts.back().trial = Trial({c});
    }
  }

  /// The same charts for another to go on with.
  ChartGroups(const ChartGroups& others, Progress& to_progress) : ChartGroups(others) {
    progress = to_progress;
  }

  static constexpr double kNoBound = std::numeric_limits<double>::infinity();

  /// The coarse chart is a little worse than the fine one.
  double CoarseBound() const {
    constexpr double kCoarseExcess = 1.3;
    return 1 + kCoarseExcess * (bound - 1);
  }
  double SeamCost(double length) const { return seam_share * params.seam_weight * kSeamPrice * length; }
  double Energy(int c) const { return charts[c].trial.energy * charts[c].area; }
  /// Of all charts and the seams between them.
  double Cost() const {
    double cost = SeamCost(SeamLength());
    for (int c = 0; c < static_cast<int>(charts.size()); ++c)
      if (charts[c].alive) cost += Energy(c);
    return cost;
  }
  /// Of the borders between charts and the cuts in them.
  double SeamLength() const {
    const std::vector<int> owner = Owners();
    double sum = 0;
    for (const Chart& chart : charts)
      if (chart.alive) sum += CutLength(chart.trial);
    for (int p = 0; p < parts.Count(); ++p)
      for (const auto& [q, length] : parts.Borders(p))
        if (p < q && owner[p] != owner[q]) sum += length;
    return sum;
  }
  /// The area of charts that nobody asked for: a tiny chart hardly adds to the seams, so without this a
  /// number of charts to reach would be made up with specks.
  double TinyArea() const {
    constexpr double kTiny = 0.003, kOfMean = 0.1;
    return params.target_charts > 0 ? std::max(kTiny, kOfMean / params.target_charts) : kTiny;
  }
  double CutLength(const ChartTrial& trial) const { return trial.cut_length / parts.Unit(); }
  /// For work that may take long.
  std::function<void()> Poll() {
    return [this] { progress.get().Poll(); };
  }

  double AreaOf(const std::vector<int>& some) const {
    double area = 0;
    for (int part : some) area += parts.Area(part);
    return area;
  }

  /// A chart of some parts, not among the charts yet.
  Chart Made(std::vector<int> of_parts) const {
    Chart chart;
    chart.area = AreaOf(of_parts);
    chart.parts = std::move(of_parts);
    return chart;
  }

  /// Sorted lists of parts as one.
  static std::vector<int> Joined(const std::vector<int>& some, const std::vector<int>& others) {
    std::vector<int> both(some.size() + others.size());
    std::merge(some.begin(), some.end(), others.begin(), others.end(), both.begin());
    return both;
  }
  std::vector<int> PartsOfBoth(int a, int b) const { return Joined(charts[a].parts, charts[b].parts); }

  /// The trial of some parts together, each made once. One that was refused because of a bound is made again
  /// for a larger one.
  const ChartTrial& Trial(const std::vector<int>& some) {
    static const ChartTrial kNotTried;
    const auto known = trials.find(some);
    if (known == trials.end()) {
      if (HoldsOverlap(some)) return kNotTried;
    } else if (known->second.second.flat || known->second.first >= CoarseBound()) {
      return known->second.second;
    }
    progress.get().Poll();
    return Record(some, SharedTrial(some, Poll()));
  }

  /// These parts are never to be a chart.
  void Forbid(const std::vector<int>& some) { trials[some] = {kNoBound, {}}; }

  /// Makes trials ahead, on all threads.
  void TryAll(const std::vector<std::vector<int>>& sets) {
    std::vector<const std::vector<int>*> open;
    for (const std::vector<int>& some : sets)
      if (trials.find(some) == trials.end() && !HoldsOverlap(some)) open.push_back(&some);
    std::vector<ChartTrial> made(open.size());
    ParallelForLargestFirst(
        static_cast<int>(open.size()), progress, [&](int k) { return parts.CoarseFaceCount(*open[k]); },
        [&](int k, const std::function<void()>& poll) { made[k] = SharedTrial(*open[k], poll); });
    for (size_t k = 0; k < open.size(); ++k) Record(*open[k], made[k]);
  }

  /// Made once by all orders; may be called by several threads at once.
  ChartTrial SharedTrial(const std::vector<int>& some, const std::function<void()>& poll) {
    if (const auto made = shared->coarse.Find(CoarseBound(), some)) return *made;
    const ChartTrial trial = TryChart(parts.CoarsePatch(some), CoarseBound(), poll);
    shared->coarse.Add(CoarseBound(), some, trial);
    return trial;
  }

  /// Its trial takes no time.
  bool IsTried(const std::vector<int>& some) const {
    return trials.count(some) > 0 || HoldsOverlap(some) || shared->coarse.Find(CoarseBound(), some);
  }

  /// Makes trials that are likely to be asked for next on idle threads, where they take long.
  void TryAhead(const std::vector<std::vector<int>>& sets) {
    if (!takes_long || sets.size() < 2) return;
    InParallel(static_cast<int>(sets.size()), Poll(),
               [&](int k, const std::function<void()>& poll) { SharedTrial(sets[k], poll); });
  }

  const ChartTrial& Record(const std::vector<int>& some, const ChartTrial& trial) {
    if (trial.overlaps) overlapping.push_back(some);
    auto& entry = trials[some];
    entry = {CoarseBound(), trial};
    return entry.second;
  }

  /// What overlaps itself still does with more around it, as nearly isometric maps hardly change by that;
  /// unless the two close a ring, which is cut open elsewhere. With a target this is not relied on.
  bool HoldsOverlap(const std::vector<int>& some) const {
    return overlaps_stay && params.target_charts == 0 &&
           std::any_of(overlapping.begin(), overlapping.end(), [&](const std::vector<int>& smaller) {
             return std::includes(some.begin(), some.end(), smaller.begin(), smaller.end());
           });
  }

  /// The chart of each part.
  std::vector<int> Owners() const {
    std::vector<int> owner(parts.Count());
    for (int c = 0; c < static_cast<int>(charts.size()); ++c)
      if (charts[c].alive)
        for (int part : charts[c].parts) owner[part] = c;
    return owner;
  }

  /// Sets the borders of all charts.
  void FindBorders() {
    const std::vector<int> owner = Owners();
    for (Chart& chart : charts) chart.borders.clear();
    for (int p = 0; p < parts.Count(); ++p)
      for (const auto& [q, length] : parts.Borders(p))
        if (owner[p] != owner[q]) charts[owner[p]].borders[owner[q]] += length;
  }

  /// Each part is a chart again.
  void TakeApart() {
    charts.resize(parts.Count());
    for (Chart& chart : charts) chart.alive = true;
    alive = parts.Count();
  }

  /// Merges two charts; returns the new one.
  int Join(int a, int b, const ChartTrial& trial) {
    Chart merged = Made(PartsOfBoth(a, b));
    merged.trial = trial;
    merged.first = a;
    merged.second = b;
    charts.push_back(std::move(merged));
    charts[a].alive = charts[b].alive = false;
    --alive;
    return static_cast<int>(charts.size()) - 1;
  }

  /// A new chart that takes the place of those its parts were in.
  void Replace(const std::vector<int>& of_parts, std::vector<int>& owner) {
    Chart chart = Made(of_parts);
    chart.trial = Trial(of_parts);
    for (int part : of_parts) owner[part] = static_cast<int>(charts.size());
    charts.push_back(std::move(chart));
  }

  /// No two of these parts are to be kept apart.
  bool MayStandTogether(const std::vector<int>& some) const { return !HoldPair(some, apart); }

  /// There is a kept border between two of these parts.
  bool HoldKeptBorder(const std::vector<int>& some) const { return HoldPair(some, parts.KeptApart()); }

  static bool HoldPair(const std::vector<int>& some, const std::set<std::pair<int, int>>& pairs) {
    return std::any_of(pairs.begin(), pairs.end(), [&](const std::pair<int, int>& pair) {
      return std::binary_search(some.begin(), some.end(), pair.first) &&
             std::binary_search(some.begin(), some.end(), pair.second);
    });
  }

  /// These parts are one piece.
  bool HangTogether(const std::vector<int>& some) const {
    std::set<int> left(some.begin(), some.end());
    std::vector<int> stack{some.front()};
    left.erase(some.front());
    while (!stack.empty()) {
      const int p = stack.back();
      stack.pop_back();
      for (const auto& [q, length] : parts.Borders(p))
        if (left.erase(q) > 0) stack.push_back(q);
    }
    return left.empty();
  }

  ChartParts<MeshType>& parts;
  const Params& params;
  std::reference_wrapper<Progress> progress;
  std::vector<Chart> charts;  ///< a merge adds one; those that are alive are a partition of the parts
  int alive = 0;
  double bound = kNoBound;  ///< on the L2 stretch of a chart
  bool takes_long = false;  ///< to try a chart: idle threads may do so in vain
  double seam_share = 1;    ///< of the price of seams: merges are taken in another order when it is less
  std::map<std::vector<int>, std::pair<double, ChartTrial>> trials;  ///< of parts: bound, trial
  std::shared_ptr<SharedTrials> shared;                              ///< by all orders
  FineChecks fine_checks{};                                          ///< on it too
  std::vector<std::vector<int>> overlapping;                         ///< parts whose chart overlapped itself
  bool overlaps_stay = true;                                         ///< what holds such parts isn't tried
  std::set<std::vector<int>> refused{};  ///< parts that failed on the fine surface as one chart
  std::set<std::pair<int, int>> apart;   ///< parts that are not to be in one chart: they would overlap, or a
                                         ///< kept border is between them
};

}  // namespace dcharts
