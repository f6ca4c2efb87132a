// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "common/parallel.h"
#include "common/progress.h"
#include "surface/chart_trial.h"
#include "surface/charts.h"
#include "surface/split_chart.h"

namespace dcharts {

/// Halves each chart that doesn't lie flat with an L2 stretch within `bound`, until all do (a single face is
/// left as it is). Every face must have a chart.
template <class MeshType>
void SplitBadCharts(const SurfaceGraph<MeshType>& surface, double bound, Progress& progress, ChartIds& ids) {
  const SeamMask no_seams(surface.FaceCount(), 0);
  PatchExtractor<MeshType> extractor(surface, no_seams);
  std::vector<char> good(surface.FaceCount(), 0);
  for (bool again = true; again;) {
    again = false;
    const std::vector<ChartPatch> patches =
        extractor.ExtractAll(FacesOfCharts(ids, [&](int f) { return !good[f]; }));
    std::vector<std::vector<int>> sides(patches.size());  // of those that are to be split
    ParallelForLargestFirst(
        static_cast<int>(patches.size()), progress, [&](int k) { return patches[k].faces.size(); },
        [&](int k, const std::function<void()>& poll) {
          if (!TryChart(patches[k], bound, poll).flat && patches[k].faces.size() > 1)
            sides[k] = Bisect(patches[k], poll);
        });
    int next_id = ChartCount(ids);
    for (size_t k = 0; k < patches.size(); ++k) {
      const std::vector<int>& faces = patches[k].faces;
      if (sides[k].empty()) {
        for (int f : faces) good[f] = 1;
        continue;
      }
      again = true;
      GiveSideAnId(patches[k], sides[k], next_id++, ids);
    }
    if (again) SplitAndCompact(surface, ids);
  }
}

}  // namespace dcharts
