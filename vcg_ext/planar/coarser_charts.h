// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "planar/chart_mesh.h"
#include "planar/coarse_chart.h"
#include "planar/normalized_chart.h"

namespace dcharts {

/// Whether a chart is so large that its map is better continued from that of a coarser chart: linear solves
/// take more than linear time.
bool IsLargeChart(const ChartMesh& chart);

/// A chart with few enough triangles for many trials, and what its vertices and faces are of another one.
struct FewTriangles {
  ChartMesh mesh;
  std::vector<int> opposite;                    ///< per half-edge, -1 at a border
  std::vector<int> source_vertex, source_face;  ///< of the chart
};

/// The coarser charts of a large chart, each made when it is first asked for: coarsening takes most of the
/// time that a large chart does, and several steps have a use for them. Not for two threads at once.
class CoarserCharts {
 public:
  explicit CoarserCharts(NormalizedChart chart) : normalized_(std::move(chart)) {}
  CoarserCharts(const CoarserCharts&) = delete;

  /// A quarter of the chart's triangles; of the chart normalized. `poll` may throw.
  const CoarseChart& Quarter(const std::function<void()>& poll);
  /// Those of the mesh of Quarter(), which may be large itself.
  CoarserCharts& OfQuarter(const std::function<void()>& poll);
  /// The last quarter of quarters, which isn't large.
  const FewTriangles& LastQuarter(const std::function<void()>& poll);
  /// Still fewer triangles, from that.
  const FewTriangles& ForTrials(const std::function<void()>& poll);

 private:
  const NormalizedChart normalized_;
  std::optional<CoarseChart> quarter_;
  std::unique_ptr<CoarserCharts> of_quarter_;
  std::optional<FewTriangles> last_quarter_, for_trials_;
};

}  // namespace dcharts
