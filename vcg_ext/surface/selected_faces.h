// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "common/surface_data.h"

namespace dcharts {

/// Runs a stage on the selected faces alone, as if there were no others, and returns the change for the whole
/// mesh, of which only those are written. Charts get the smallest numbers that no other face has.
/// Throws Error when no face is selected.
SurfaceChange OnSelectedFaces(const SurfaceData& mesh,
                              const std::function<SurfaceChange(const SurfaceData&)>& stage);

}  // namespace dcharts
