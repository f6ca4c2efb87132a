// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "planar/chart_mesh.h"

namespace dcharts {

struct PackOptions {
  int texture_size = 1024;  ///< texels
  int padding = 2;          ///< texels between charts; half as many along the edge of the texture
  bool rotate = true;       ///< turn charts; otherwise they keep their direction
};

/// Where a chart goes: uv -> scale * R(angle) * uv + offset, in [0,1]^2.
struct Placement {
  double angle = 0;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

struct Packing {
  double scale = 1;    ///< the same for all charts
  double padding = 0;  ///< texels that charts are at least apart, along rows or columns of texels, so that as
                       ///< many texels stay free; less than asked when there are too many charts
  std::vector<Placement> placements;
};

/// Packs charts into the unit square by their true outlines, large ones first, each where it lets the square
/// grow least (after [LPRM02], with all places of a grid tried instead of a horizon). Up to 100 charts are
/// then squeezed together (packing_squeeze.h), up to 5,000 compacted (packing_compact.h). One scale for all.
/// `outlines`: per chart the end points of its boundary edges, two rows per edge. `poll` is called now and
/// then and may throw. Throws Error when there are too many charts for the texture.
Packing Pack(const std::vector<Points2>& outlines, const PackOptions& options,
             const std::function<void()>& poll = {});

}  // namespace dcharts
