// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "pattern/drawing/drawing.h"

namespace dcharts {

/// The picture's pixels as a PNG file. Throws Error when there is no memory for it.
std::vector<std::uint8_t> PngFile(const Picture& picture);

}  // namespace dcharts
