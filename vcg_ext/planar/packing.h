// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planar/chart_mesh.h"

namespace dcharts {

struct PackOptions {
  int texture_size = 1024;  ///< texels
  int padding = 2;          ///< texels between charts
  bool rotate = true;       ///< turn charts; otherwise they keep their direction
};

/// Where a chart goes: uv -> scale * R(angle) * uv + offset, in [0,1]^2.
struct Placement {
  double angle = 0;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

struct Packing {
  double scale = 1;  ///< the same for all charts
  double padding =
      0;  ///< texels that the charts really are apart: less than asked when there are too many of them
  std::vector<Placement> placements;
};

/// Packs charts into the unit square as [LPRM02] do: tall ones first, each dropped onto the horizon of those
/// before where it rests lowest, by the profile of its own outline. One scale for all, the largest that fits.
/// `outlines`: per chart the end points of its boundary edges, two rows per edge.
Packing Pack(const std::vector<Points2>& outlines, const PackOptions& options);

}  // namespace dcharts
