// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "pattern/drawing/drawing.h"

namespace dcharts {

/// The drawing as DXF R12, by ASTM D6673: units are millimetres; one block for each piece, inserted once;
/// layers are numbers (1 cut, 2 turn points, 3 curve points, 4 notches, 7 grain, 8 internal lines, 14 sew
/// line, 15 text), of which those that are used are declared. Pictures are left out, R12 has none.
/// Lines say what they belong to as extended data of the application DCHARTS: names, each followed by a
/// number: "seam" and "side" (from 1) of a stitch line, a net and a notch, "match" of a notch, "angle" of a
/// fold.
std::string DxfFile(const Drawing& drawing);

}  // namespace dcharts
