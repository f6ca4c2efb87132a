// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "planar/packing.h"

namespace dcharts {

struct CompactOptions {
  double padding = 0;    ///< least distance of charts along x or y (the larger of the two), as a share of the
                         ///< square's side; half of it along the sides
  bool rotate = true;    ///< else angles stay as they are
  int most_steps = 300;  ///< of the whole search; bounds the time
};

/// Lets packed charts grow together while they push each other aside, turning freely, until they are jammed:
/// per step the contacts (corner of one outline to edge of another) become linear inequalities, which
/// projected Gauss-Seidel meets with little motion. `packing` is where to start, with charts that may overlap
/// by a little. Returns true and the new packing when it is sound, by an exact test of the outlines, and has
/// a larger scale than `least_scale`; else leaves `packing` as it was. Always gives the same for the same
/// input.
bool Compact(const std::vector<Points2>& outlines, const CompactOptions& options, double least_scale,
             const std::function<void()>& poll, Packing* packing);

}  // namespace dcharts
