// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

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

/// Calls visit(patch) for every chart.
template <class MeshType, class Visit>
void ForEachChart(const SurfaceGraph<MeshType>& surface, const ChartIds& ids, const SeamMask& seams,
                  Progress& progress, const Visit& visit) {
  // Patches are taken from the state at the start: cuts of one chart don't touch another's.
  const SeamMask before = seams;
  PatchExtractor<MeshType> extractor(surface, before);
  for (const auto& faces : FacesOfCharts(ids)) {
    progress.Poll();
    visit(extractor.Extract(faces));
  }
}

/// The cuts that no chart can do without: after it every chart has a boundary and no handle. Returns how many
/// charts it had to cut. `ids` change where a chart falls apart along its cuts.
template <class MeshType>
int OpenHandles(const SurfaceGraph<MeshType>& surface, Progress& progress, ChartIds& ids, SeamMask& seams) {
  int opened = 0;
  // A cut along a chart's own boundary may part it; then its pieces are looked at again.
  for (bool changed = true; changed;) {
    changed = false;
    ForEachChart(surface, ids, seams, progress, [&](const ChartPatch& patch) {
      const std::vector<int> cuts = CutsThatOpenHandles(patch);
      MarkCuts(surface, patch, cuts, seams);
      opened += !cuts.empty();
      changed |= !cuts.empty();
    });
    if (changed) SplitAndCompact(surface, ids, &seams);
  }
  return opened;
}

/// Cuts between boundary loops of a chart (Section 3.3).
template <class MeshType>
void JoinLoops(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress,
               const ChartIds& ids, SeamMask& seams) {
  ForEachChart(surface, ids, seams, progress, [&](const ChartPatch& patch) {
    MarkCuts(surface, patch, CutsThatJoinLoops(patch, params.cut_to_disk), seams);
  });
}

}  // namespace dcharts
