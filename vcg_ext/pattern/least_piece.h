// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params.h"

namespace dcharts {

/// A piece with a smaller net (mm^2) is hard to sew or to glue: of fabric, allowances are wider than it.
inline double LeastPieceArea(const Params& params) {
  const double width =
      params.material == PatternMaterial::kFabric ? 3 * params.seam_allowance : 2 * params.tab_width;
  return width * width;
}

/// So is a narrower one (mm), however long.
inline double LeastPieceWidth(const Params& params) {
  return params.material == PatternMaterial::kFabric ? params.seam_allowance : params.tab_width / 2;
}

}  // namespace dcharts
