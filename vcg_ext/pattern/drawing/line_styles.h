// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "pattern/drawing/drawing.h"

namespace dcharts {

struct LineStyle {
  const char* layer;                  ///< its name in SVG
  int astm_layer;                     ///< its number in DXF (ASTM D6673)
  const char* line_type;              ///< its name in DXF
  double width;                       ///< mm
  std::vector<double> dashes;         ///< mm, on and off in turn; empty: solid
  std::array<std::uint8_t, 3> color;  ///< RGB
};

const LineStyle& StyleOf(Mark mark);

/// All marks, in the order in which they are drawn.
const std::vector<Mark>& AllMarks();

/// The layers of ASTM D6673 that are used besides those of lines.
inline constexpr int kAstmTurnPoints = 2;
inline constexpr int kAstmCurvePoints = 3;
inline constexpr int kAstmText = 15;

}  // namespace dcharts
