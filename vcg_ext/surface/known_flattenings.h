// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "planar/coarser_charts.h"
#include "planar/flatten.h"
#include "surface/chart_patch.h"
#include "surface/stretch_darts.h"

namespace dcharts {

/// Charts that were flattened with least stretch by an earlier stage of the same run, and darts that were
/// found for others, so that a later one need not do it again. It finds what it would have computed, as that
/// depends on the chart alone.
class KnownFlattenings {
 public:
  void Add(const ChartPatch& patch, Flattening flat, std::shared_ptr<CoarserCharts> coarser = nullptr) {
    flat_[patch.faces.front()] = {patch.faces, patch.opposite, {std::move(flat), std::move(coarser)}};
  }

  /// Null when this very chart, cut in the same way, isn't known.
  const Flattening* Find(const ChartPatch& patch) const {
    const auto* const found = FindIn(flat_, patch);
    return found ? &found->first : nullptr;
  }

  /// Of a large chart that was flattened; may be null.
  std::shared_ptr<CoarserCharts> FindCoarser(const ChartPatch& patch) const {
    const auto* const found = FindIn(flat_, patch);
    return found ? found->second : nullptr;
  }

  /// What CutStretchDarts made of `patch` by a goal without a bound on the worst stretch. Kept when that was
  /// reached.
  void AddDarts(const ChartPatch& patch, const DartGoal& goal, DartedChart darted) {
    if (darted.count > 0 && darted.flat.ok && darted.flat.l2_stretch <= goal.l2_stretch)
      darts_[patch.faces.front()] = {patch.faces, patch.opposite, {goal, std::move(darted)}};
  }

  /// All that is known of a chart that is to be cut by `goal`.
  KnownOfChart Of(const ChartPatch& patch, const DartGoal& goal) const {
    return {Find(patch), FindDarts(patch, goal), FindCoarser(patch)};
  }

 private:
  using GoalAndDarts = std::pair<DartGoal, DartedChart>;
  template <class Value>
  struct Entry {
    std::vector<int> faces, opposite;
    Value value;
  };
  template <class Value>
  using ByFirstFace = std::map<int, Entry<Value>>;

  template <class Value>
  static const Value* FindIn(const ByFirstFace<Value>& entries, const ChartPatch& patch) {
    const auto found = entries.find(patch.faces.front());
    if (found == entries.end() || found->second.faces != patch.faces ||
        found->second.opposite != patch.opposite)
      return nullptr;
    return &found->second.value;
  }

  // Null when darts for the mean stretch of this very chart aren't known by a goal like `goal`.
  const DartedChart* FindDarts(const ChartPatch& patch, const DartGoal& goal) const {
    const GoalAndDarts* const found = FindIn(darts_, patch);
    const bool is_like = found && found->first.l2_stretch == goal.l2_stretch &&
                         found->first.longest == goal.longest && found->first.most_darts <= goal.most_darts;
    return is_like ? &found->second : nullptr;
  }

  ByFirstFace<std::pair<Flattening, std::shared_ptr<CoarserCharts>>> flat_;
  ByFirstFace<GoalAndDarts> darts_;
};

}  // namespace dcharts
