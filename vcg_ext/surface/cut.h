// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/params.h"
#include "common/progress.h"
#include "planar/cone_proxy.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/darts.h"
#include "surface/open_chart.h"
#include "surface/patch_paths.h"
#include "surface/seams.h"

namespace dcharts {

/// Cuts inside charts (Section 3.3, "Darts and gussets"). Seams only ever get more.
template <class MeshType>
class ChartCutter {
 public:
  ChartCutter(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface), params_(params), progress_(progress) {}

  /// All cuts: handles, loops, darts. `seams` is set anew. Returns the number of darts.
  int Run(ChartIds& ids, SeamMask& seams) {
    seams = ChartBorders(surface_, ids);
    OpenHandles(ids, seams);
    progress_.Update(0.3);
    JoinLoops(ids, seams);
    progress_.Update(0.6);
    const int darts = CutDarts(ids, seams);
    DropIneffectiveSeams(surface_, seams);
    return darts;
  }

  /// The cuts that no chart can do without: after it every chart has a boundary and no handle. Returns how
  /// many charts it had to cut.
  int OpenHandles(ChartIds& ids, SeamMask& seams) {
    int opened = 0;
    // A cut along a chart's own boundary may part it; then its pieces are looked at again.
    for (bool changed = true; changed;) {
      changed = false;
      ForEachChart(ids, seams, [&](const ChartPatch& patch) {
        const std::vector<int> cuts = CutsThatOpenHandles(patch);
        Mark(patch, cuts, seams);
        opened += !cuts.empty();
        changed |= !cuts.empty();
      });
      if (changed) SplitAndCompact(surface_, ids, &seams);
    }
    return opened;
  }

  void JoinLoops(const ChartIds& ids, SeamMask& seams) {
    ForEachChart(ids, seams, [&](const ChartPatch& patch) {
      Mark(patch, CutsThatJoinLoops(patch, params_.cut_to_disk), seams);
    });
  }

  /// Makes the given cuts (local half-edges of the patch) seams.
  void Mark(const ChartPatch& patch, const std::vector<int>& edges, SeamMask& seams) const {
    for (int h : edges) {
      const int s = patch.SurfaceHalfEdge(h);
      SetSeam(seams, s);
      SetSeam(seams, surface_.Opposite(s));
    }
  }

 private:
  template <class Visit>
  void ForEachChart(const ChartIds& ids, const SeamMask& seams, const Visit& visit) {
    // Patches are taken from the state at the start: cuts of one chart don't touch another's.
    const SeamMask before = seams;
    PatchExtractor<MeshType> extractor(surface_, before);
    for (const auto& faces : FacesOfCharts(ids)) {
      progress_.Poll();
      visit(extractor.Extract(faces));
    }
  }

  int CutDarts(const ChartIds& ids, SeamMask& seams) {
    int count = 0;
    ForEachChart(ids, seams, [&](const ChartPatch& patch) {
      NormalMoments moments;
      for (int f : patch.faces) moments.Add(surface_.Area(f), surface_.Normal(f));
      const ConeProxy proxy = FitCone(moments);
      std::vector<double> error;
      for (int f : patch.faces) error.push_back(FittingError(proxy, surface_.Normal(f)));
      const Darts darts = PlanDarts(patch, error, params_);
      Mark(patch, darts.edges, seams);
      count += darts.count;
    });
    return count;
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
};

}  // namespace dcharts
