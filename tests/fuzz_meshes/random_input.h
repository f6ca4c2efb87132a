// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/params.h"
#include "common/surface_data.h"
#include "filter_table.h"
#include "random.h"

namespace dcharts::fuzz {

/// Sometimes gives the mesh face quality (charts of all kinds, and numbers that are none), vertex quality,
/// texcoords, seams, textures and colours. Vertices and faces must be there already.
void AddAttributes(Random& random, SurfaceData& mesh);

/// Most at their defaults, some anywhere in their range or at its ends, and now and then one outside or not a
/// number. `text` gets those that are not the default.
Params RandomParams(Random& random, const FilterSpec& filter, std::string& text);

}  // namespace dcharts::fuzz
