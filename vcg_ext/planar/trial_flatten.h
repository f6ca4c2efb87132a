// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <string>

#include "planar/chart_mesh.h"

namespace dcharts {

class CoarserCharts;

struct TrialOptions {
  /// Asked is whether the chart's L2 stretch is at most this. The trial ends as soon as it is sure to stay
  /// above; 1 and more, infinity to find the stretch itself.
  double l2_bound = std::numeric_limits<double>::infinity();
  /// The first map whose stretch is within the bound will do: the answer is the same, `l2_stretch` less
  /// exact.
  bool decide_only = false;
  /// A map that overlaps itself won't do; the trial ends early when its start overlaps clearly.
  bool no_overlap = false;
  /// Most Newton steps; 3 are within a tenth of the full flattening's L2 - 1 on nine charts of ten.
  int newton_steps = 4;
  /// UVs to start from, #V by 2 in any scale, for instance those the chart had before a dart was cut into it.
  /// Ignored when a triangle is flipped in them. May be null.
  const Points2* start = nullptr;
  /// Of a large chart, where there are some; may be null.
  CoarserCharts* coarser = nullptr;
};

/// With no_overlap: a map whose rim overlaps in so many pairs of triangles stays so, whatever is done to it.
constexpr size_t kClearOverlap = 4;

struct TrialFlattening {
  bool ok = false;        ///< a map without flips was found that is as the options ask
  bool rejected = false;  ///< not ok because of the bound: the figures are those of the last map, above it
  size_t overlaps = 0;    ///< with no_overlap: pairs of triangles that overlap, at most kClearOverlap
  std::string why;        ///< why there is no map at all (not flat, not a chart); empty when ok or rejected
  double energy = 0;      ///< area-weighted mean of symmetric Dirichlet / 4 - 1 at the map's own scale, >= 0
  double l2_stretch = 0;  ///< at the chart's own scale, as Flattening's; an overestimate of what that reaches
  double linf_stretch = 0;
  Points2 uv;  ///< #V by 2, model units, UV area = surface area; empty when there is no map. May
               ///< overlap itself; too-thin triangles are not made safe for float32
};

/// A quick stretch-minimizing flattening that tells how well a chart would lie flat, for merges and darts: a
/// start from angles and a few Newton steps on the L2 stretch, without the finish of Flatten(), in a quarter
/// of its time. On 97 charts of 100 its L2 - 1 is at most a tenth above the least that can be reached, which
/// is also what Flatten() reaches but for what it pays for a lower Linf, see FlattenOptions::l2_bound. `poll`
/// is called now and then and may throw. Safe to call from several threads; the result depends on nothing but
/// the arguments.
TrialFlattening TrialFlatten(const ChartMesh& chart, const TrialOptions& options = {},
                             const std::function<void()>& poll = {});

}  // namespace dcharts
