// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <vector>

#include "common/params.h"
#include "common/progress.h"
#include "planar/cone_proxy.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/charts_for.h"
#include "surface/cut_by_stretch.h"
#include "surface/darts.h"
#include "surface/known_flattenings.h"
#include "surface/needed_cuts.h"
#include "surface/seams.h"

namespace dcharts {

/// Cuts inside charts (Section 3.3, "Darts and gussets").
template <class MeshType>
class ChartCutter {
 public:
  ChartCutter(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface), params_(params), progress_(progress) {}

  /// All cuts: handles, loops, darts. `seams` is set anew. `ids` change where a chart falls apart along its
  /// cuts, and where one had to be parted to keep within params.max_stretch. Returns the number of darts.
  /// Flattenings that were made on the way are left in `known`, where Merge may have left what it found.
  int Run(ChartsFor use, ChartIds& ids, SeamMask& seams, KnownFlattenings& known) {
    seams = ChartBorders(surface_, ids);
    OpenHandles(surface_, progress_, ids, seams);
    progress_.Update(0.3);
    JoinLoops(surface_, params_, progress_, ids, seams);
    progress_.Update(0.6);
    const bool by_stretch = params_.dart_by == DartMethod::kMeasuredStretch;
    int darts = by_stretch ? 0 : CutByFittingError(ids, seams);
    StretchCutter<MeshType> cutter(surface_, params_, progress_);
    if (by_stretch || cutter.MayPart()) darts += cutter.Run(use, ids, seams, known);
    DropIneffectiveSeams(surface_, seams);
    return darts;
  }

 private:
  int CutByFittingError(const ChartIds& ids, SeamMask& seams) {
    std::atomic<int> count{0};
    CutCharts(surface_, ids, progress_, seams, [&](const ChartPatch& patch) {
      NormalMoments moments;
      for (int f : patch.faces) moments.Add(surface_.Area(f), surface_.Normal(f));
      const ConeProxy proxy = FitCone(moments);
      std::vector<double> error;
      for (int f : patch.faces) error.push_back(FittingError(proxy, surface_.Normal(f)));
      const Darts darts = PlanDarts(patch, error, params_);
      count += darts.count;
      return darts.edges;
    });
    return count;
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
};

}  // namespace dcharts
