// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/surface_data.h"
#include "random.h"

namespace dcharts::fuzz {

/// Makes a mesh worse in one random way: faces flipped, doubled, taken away, with repeated vertices, on an
/// edge that has two already; vertices made one, moved together, to a line or far away, unreferenced, not
/// finite; another shape beside, inside or through it; scales and offsets; another order. `name` gets what
/// was done.
void Mutate(Random& random, SurfaceData& mesh, std::string& name);

}  // namespace dcharts::fuzz
