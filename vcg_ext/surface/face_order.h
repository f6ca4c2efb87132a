// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/surface_data.h"

namespace dcharts {

/// Faces of a large mesh (indices into `data.faces`) in an order in which those near each other in space are
/// near each other in memory (along a Z-order curve): a third of the time goes to waiting for memory
/// otherwise. Those of a smaller mesh keep their order.
void SortForMemory(const SurfaceData& data, std::vector<int>& faces);

}  // namespace dcharts
