// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pattern/flat_charts.h"
#include "pattern/pattern.h"

namespace dcharts {

/// Sets the direction of the fabric's grain on each piece: the one that runs along the longest axis of the
/// model's box, so that the nap lies the same way all over; across a piece that is upright to that axis, any.
void SetGrain(const FlatCharts& charts, Pattern& pattern);

}  // namespace dcharts
