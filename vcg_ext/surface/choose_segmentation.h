// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "common/params.h"
#include "common/progress.h"
#include "surface/coarse_copy.h"
#include "surface/denoised_normals.h"
#include "surface/fill.h"
#include "surface/lloyd.h"
#include "surface/straighten.h"
#include "surface/trial_merge.h"

namespace dcharts {

/// Segment: one segmentation, or, where params.target_charts tells what is to become of it, two with
/// different numbers of seeds, of which the one is taken that merges better. How well a segmentation merges
/// varies by some percent from one to the next, and can't be told from its own figures.
template <class MeshType>
class SegmentationChooser {
 public:
  SegmentationChooser(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface), params_(params), progress_(progress) {}

  /// The smaller of the two numbers of seeds.
  static int Fewer(int enough) { return std::max(1, enough * 4 / 5); }

  Segmentation Run() {
    constexpr int kManyFaces = 100000;
    if (surface_.FaceCount() > kManyFaces) return FromCoarser();
    if (params_.chart_count > 0 || params_.target_charts == 0)
      return Lloyd<MeshType>(surface_, params_, progress_).Run();
    const int enough = Lloyd<MeshType>::EnoughCharts(params_, surface_.FaceCount());
    const std::array<int, 2> candidates{Fewer(enough), enough};
    Segmentation best;
    double best_cost = 0;
    for (size_t k = 0; k < candidates.size(); ++k) {
      Progress part([&](int percent, const char*) {
        progress_.Update((static_cast<double>(k) + percent / 100.0) / static_cast<double>(candidates.size()));
        progress_.Poll();
        return true;
      });
      Params params = params_;
      params.chart_count = candidates[k];
      Segmentation candidate = Lloyd<MeshType>(surface_, params, part).Run();
      const double cost = Cost(candidate.ids, part);
      if (k > 0 && cost >= best_cost) continue;
      best_cost = cost;
      best = std::move(candidate);
    }
    return best;
  }

 private:
  // A coarser copy is enough to find charts and their number; the surface itself then has little to set
  // right.
  Segmentation FromCoarser() {
    constexpr int kEnoughFaces = 50000, kFacesPerChart = 100;
    const int most = std::max(kEnoughFaces, kFacesPerChart * params_.chart_count);
    if (most >= surface_.FaceCount()) return Lloyd<MeshType>(surface_, params_, progress_).Run();
    CoarseCopy copy(surface_, ChartIds(surface_.FaceCount(), 0), most, [&] { progress_.Poll(); });
    DenoiseNormals(copy.Graph(), [&] { progress_.Poll(); });
    progress_.Update(0.3);
    constexpr double kShare = 0.7;
    Progress part([&](int percent, const char*) {
      progress_.Update(0.3 + (kShare - 0.3) * percent / 100.0);
      progress_.Poll();
      return true;
    });
    const Segmentation coarse = SegmentationChooser<SurfaceMesh>(copy.Graph(), params_, part).Run();
    std::vector<GrowingChart> charts = Lloyd<SurfaceMesh>(copy.Graph(), params_, part).ChartsOf(coarse.ids);
    for (GrowingChart& chart : charts) chart.seed = copy.SourceFace(chart.seed);
    Segmentation result = Lloyd<MeshType>(surface_, params_, progress_).RunFrom(std::move(charts));
    result.iterations += coarse.iterations;
    return result;
  }

  // Of the atlas, as far as a stage knows that has the parameters of Segment.
  double Cost(ChartIds ids, Progress& progress) const {
    Params params;
    params.max_fitting_error = params_.max_fitting_error;
    params.fitting_weight = params_.fitting_weight;
    params.compactness_weight = params_.compactness_weight;
    params.straightness_weight = params_.straightness_weight;
    params.target_charts = params_.target_charts;
    params.max_stretch = params_.max_stretch;
    HoleFiller<MeshType>(surface_, params, progress).Run(ids);
    StraightenBorders(surface_, params, progress, ids);
    return TrialMerger<MeshType>(surface_, params, progress).CoarseCost(std::move(ids));
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
};

}  // namespace dcharts
