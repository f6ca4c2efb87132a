// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "pattern/drawing/drawing.h"

namespace dcharts {

/// The drawing as SVG 1.1: width and height in mm and one unit a millimetre; a group for each group of the
/// drawing, in it a group (a layer of Inkscape) for each kind of line; text as text.
std::string SvgFile(const Drawing& drawing);

}  // namespace dcharts
