// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "common/surface_data.h"
#include "pattern/pattern.h"

namespace dcharts {

/// The drawn pieces' net outlines as triangles, where they lie on the single sheet, z = 0.
FlatLayer LayerOf(const Pattern& pattern);

/// The colour of a piece, in the layer and in pictures.
std::array<std::uint8_t, 3> PieceColor(int piece);

}  // namespace dcharts
