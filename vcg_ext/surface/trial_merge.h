// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "common/params.h"
#include "common/progress.h"
#include "surface/charts.h"
#include "surface/merge_orders.h"
#include "surface/refine_borders.h"
#include "surface/refine_on_copy.h"
#include "surface/split_bad_charts.h"

namespace dcharts {

/// Merging charts by trial flattening: of all pairs of neighbours, the one first that adds the least stretch
/// for the seam it saves. Takes the place of the merge test of Section 3.3.
template <class MeshType>
class TrialMerger {
 public:
  TrialMerger(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface), params_(params), progress_(progress) {}

  /// Every face must have a chart. Charts that don't lie flat well by themselves are split first; then charts
  /// are merged until there are params.target_charts, or, without a target, as long as the stretch of each
  /// stays within params.max_stretch, or, without a bound, as long as a shorter seam is worth the stretch. At
  /// last the borders are moved to better places. Darts that charts were found to need are left in `known`.
  void Run(ChartIds& ids, KnownFlattenings& known) {
    Split(ids);
    ChartParts<MeshType> parts = Parts(ids);
    ChartGroups<MeshType> groups(parts, params_, progress_);
    const bool is_copied = parts.Fine().Graph().FaceCount() < surface_.FaceCount();
    MergeOrders<MeshType>(groups, is_copied ? nullptr : &known).Run();
    const std::vector<int> owner = groups.Owners();
    for (int& id : ids) id = owner[id];
    SplitAndCompact(surface_, ids);
    if (is_copied)
      RefineBordersOnCopy(surface_, parts.Fine(), groups.shared->fine, params_, progress_, ids);
    else
      BorderRefiner<MeshType>(surface_, params_, progress_).Run(groups.shared->fine, ids);
  }

  /// What ChartGroups::Cost() would be after Run(), by trials on the coarse copy alone: only to compare
  /// segmentations of one surface by.
  double CoarseCost(ChartIds ids) {
    Split(ids);
    ChartParts<MeshType> parts = Parts(ids);
    ChartGroups<MeshType> groups(parts, params_, progress_);
    GreedyMerger<MeshType> greedy(groups);
    groups.bound = params_.StretchBound();
    greedy.Run();
    if (params_.target_charts > 0 && greedy.MayMergeMore()) {
      groups.bound = groups.kNoBound;
      greedy.ForgetFailures();
      greedy.Run();
    }
    const auto before = groups.charts;
    MergeImprover<MeshType>(groups).Run(before);
    return groups.Cost();
  }

 private:
  void Split(ChartIds& ids) {
    constexpr double kGood = 1.01;  // a segment that lies flat worse than this is better split
    SplitBadCharts(surface_, std::min(kGood, params_.StretchBound()), progress_, ids);
  }

  ChartParts<MeshType> Parts(const ChartIds& ids) const {
    return ChartParts<MeshType>(surface_, ids, params_.target_charts > 0, ChartParts<MeshType>::kFineFaces,
                                [&] { progress_.Poll(); });
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
};

}  // namespace dcharts
