// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "common/progress.h"
#include "common/work_ahead.h"
#include "surface/checked_merge.h"

namespace dcharts {

/// Merges charts once more, from the same parts in another order: seams count less, and so do the merges that
/// save the most of them.
template <class MeshType>
class OtherOrder {
 public:
  struct Outcome {
    std::vector<typename ChartGroups<MeshType>::Chart> charts{};
    int alive = 0;
    double seams = 0;  ///< their length
  };

  /// What failed in `groups` is not tried again. For `known` see CheckedMerger.
  OtherOrder(const ChartGroups<MeshType>& groups, KnownFlattenings* known, double bound)
      : progress_([this](int, const char*) {
          (*poll_)();
          return true;
        }),
        groups_(groups, progress_),
        merger_(groups_, known),
        bound_(bound),
        work_({[this](const Poll& poll) { MergeWithoutDarts(poll); },
               [this](const Poll& poll) { MergeOnWithDarts(poll); }}) {
    groups_.TakeApart();
  }

  /// Begins on a thread that is idle, with what may be needed.
  void Begin() { work_.Begin(); }

  const Outcome& WithoutDarts(const Poll& poll) {
    work_.Finish(1, poll);
    return without_darts_;
  }
  const Outcome& WithDarts(const Poll& poll) {
    work_.Finish(2, poll);
    return with_darts_;
  }

 private:
  void MergeWithoutDarts(const Poll& poll) {
    // Where little is known to fail yet, the order has to differ more.
    constexpr double kShare = 0.2, kShareAhead = 0.1;
    poll_ = &poll;
    groups_.seam_share = groups_.takes_long ? kShareAhead : kShare;
    merger_.Merge(bound_);
    merger_.Dissolve();
    groups_.seam_share = 1;
    without_darts_ = Now();
  }

  void MergeOnWithDarts(const Poll& poll) {
    poll_ = &poll;
    merger_.MergeWithDarts(CheckedMerger<MeshType>::Effort::kUsual);
    merger_.Dissolve();
    with_darts_ = Now();
  }

  Outcome Now() const { return {groups_.charts, groups_.alive, groups_.SeamLength()}; }

  const Poll* poll_ = nullptr;
  Progress progress_;
  ChartGroups<MeshType> groups_;
  CheckedMerger<MeshType> merger_;
  const double bound_;
  Outcome without_darts_, with_darts_;
  WorkAhead work_;  // ends first
};

/// Merges charts by trials as params ask for: to a number of charts, or, with a bound on their stretch alone,
/// to as few as can be, for which two orders are tried.
template <class MeshType>
class MergeOrders {
 public:
  /// For `known` see CheckedMerger; where it is null, trials take long.
  MergeOrders(ChartGroups<MeshType>& groups, KnownFlattenings* known)
      : groups_(groups), known_(known), merger_(groups, known) {
    groups_.takes_long = !known;
  }

  void Run() {
    const double bound = groups_.params.StretchBound();
    if (groups_.params.target_charts == 0 && bound < kNoBound) {
      MergeToFewest(bound);
    } else {
      merger_.Merge(bound);
      if (bound < kNoBound) merger_.MergeWithDarts(Effort::kUsual);
    }
    if (groups_.params.target_charts > 0 && merger_.MayMergeMore()) merger_.Merge(kNoBound);
    merger_.Improve();
  }

 private:
  using Effort = typename CheckedMerger<MeshType>::Effort;
  static constexpr double kNoBound = ChartGroups<MeshType>::kNoBound;
  static constexpr int kFew = 3, kMany = 8;  // charts

  void MergeToFewest(double bound) {
    std::optional<OtherOrder<MeshType>> other;
    if (!known_) {
      merger_.MergeUnchecked(bound);
      if (groups_.alive > kFew) {  // likely to be needed, and worth a thread of its own
        other.emplace(groups_, known_, bound);
        other->Begin();
      }
    }
    merger_.Merge(bound);
    merger_.MergeWithDarts(Effort::kUsual);
    merger_.Dissolve();
    if (MayBeTooMany() || MayNeedFewerDarts()) {
      if (!other) other.emplace(groups_, known_, bound);
      TakeBetter(*other);
    }
    other.reset();
    if (IsWorthMostEffort()) merger_.MergeWithDarts(Effort::kMost);
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
  bool MayNeedFewerDarts() const { return merger_.MergesWithDarts() > (groups_.alive <= kFew ? 1 : 0); }

  // What each try costs is little beside what one chart of a few is worth.
  bool IsWorthMostEffort() const {
    return groups_.alive > kFew && groups_.alive <= kMany &&
           groups_.params.method == FlattenMethod::kStretchMinimizing;
  }

  // The one with fewer charts, or with as many and shorter seams.
  void TakeBetter(OtherOrder<MeshType>& other) {
    const Poll poll = groups_.Poll();
    const auto* outcome = &other.WithoutDarts(poll);
    const bool has_fewer = outcome->alive < groups_.alive;
    // Where trials take long, darts are not to make up for charts that it has more.
    const bool may_make_up = !groups_.takes_long || outcome->alive == groups_.alive;
    if (has_fewer || (merger_.MergesWithDarts() > 0 && may_make_up)) outcome = &other.WithDarts(poll);
    if (std::make_pair(outcome->alive, outcome->seams) >= std::make_pair(groups_.alive, groups_.SeamLength()))
      return;
    groups_.charts = outcome->charts;
    groups_.alive = outcome->alive;
  }

  ChartGroups<MeshType>& groups_;
  KnownFlattenings* const known_;
  CheckedMerger<MeshType> merger_;
};

}  // namespace dcharts
