// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/surface_data.h"
#include "pattern/pattern.h"

namespace dcharts {

/// Throws Error with a sentence when the path's ending is none of .svg, .pdf and .dxf (in any case), or it
/// can be seen that no such file can be written.
void CheckOutputFile(const std::string& path);

/// Draws the pattern and writes it to the file, in the format of its ending; a relative path is relative to
/// the working directory. `mesh` is what the pattern was made of. Returns sentences for the log: what was
/// written, and what found no room. Throws Error; then there is no file, or the one that was there before.
std::vector<std::string> WritePattern(const Pattern& pattern, const SurfaceData& mesh, const Params& params);

}  // namespace dcharts
