// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "surface/charts.h"

namespace dcharts {

/// A side of an edge is no seam any more.
inline void ClearSeam(SeamMask& seams, int half_edge) {
  seams[half_edge / 3] = static_cast<std::uint8_t>(seams[half_edge / 3] & ~(1 << (half_edge % 3)));
}

inline void MarkSeam(SeamMask& seams, int half_edge, bool is_seam) {
  is_seam ? SetSeam(seams, half_edge) : ClearSeam(seams, half_edge);
}

}  // namespace dcharts
