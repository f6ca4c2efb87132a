// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "common/parallel.h"
#include "common/params.h"
#include "common/progress.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/open_chart.h"
#include "surface/seams.h"

namespace dcharts {

/// Makes the given cuts (local half-edges of the patch) seams.
template <class MeshType>
void MarkCuts(const SurfaceGraph<MeshType>& surface, const ChartPatch& patch, const std::vector<int>& edges,
              SeamMask& seams) {
  for (int h : edges) {
    const int s = patch.SurfaceHalfEdge(h);
    SetSeam(seams, s);
    SetSeam(seams, surface.Opposite(s));
  }
}

/// Makes the cuts that cuts_of(patch) returns, which may be called for several charts at once, seams. Returns
/// how many charts have cuts.
template <class MeshType, class CutsOf>
int CutCharts(const SurfaceGraph<MeshType>& surface, const ChartIds& ids, Progress& progress, SeamMask& seams,
              const CutsOf& cuts_of) {
  const std::vector<ChartPatch> patches =
      PatchExtractor<MeshType>(surface, seams).ExtractAll(FacesOfCharts(ids));
  std::vector<std::vector<int>> cuts(patches.size());
  InParallelIf(
      surface.FaceCount() >= PatchExtractor<MeshType>::kManyFaces, static_cast<int>(patches.size()),
      [&] { progress.Poll(); },
      [&](int k, const std::function<void()>& poll) {
        poll();
        cuts[k] = cuts_of(patches[k]);
      });
  int count = 0;
  for (size_t k = 0; k < patches.size(); ++k) {
    MarkCuts(surface, patches[k], cuts[k], seams);
    count += !cuts[k].empty();
  }
  return count;
}

/// The cuts that no chart can do without: after it every chart has a boundary and no handle. Returns how many
/// charts it had to cut. `ids` change where a chart falls apart along its cuts.
template <class MeshType>
int OpenHandles(const SurfaceGraph<MeshType>& surface, Progress& progress, ChartIds& ids, SeamMask& seams) {
  int opened = 0;
  // A cut along a chart's own boundary may part it; then its pieces are looked at again.
  for (bool changed = true; changed;) {
    const int count = CutCharts(surface, ids, progress, seams, CutsThatOpenHandles);
    changed = count > 0;
    opened += count;
    if (changed) SplitAndCompact(surface, ids, &seams);
  }
  return opened;
}

/// Cuts between boundary loops of a chart (Section 3.3).
template <class MeshType>
void JoinLoops(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress,
               const ChartIds& ids, SeamMask& seams) {
  CutCharts(surface, ids, progress, seams,
            [&](const ChartPatch& patch) { return CutsThatJoinLoops(patch, params.cut_to_disk); });
}

}  // namespace dcharts
