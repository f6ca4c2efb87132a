// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/surface_data.h"

namespace dcharts::shapes {

/// Vertices (float32) and faces as a binary little-endian PLY file. Throws std::runtime_error when it can't
/// be written.
void WritePly(const SurfaceData& mesh, const std::string& path);

}  // namespace dcharts::shapes
