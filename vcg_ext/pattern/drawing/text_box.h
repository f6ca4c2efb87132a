// SPDX-License-Identifier: GPL-3.0-or-later
/// How much room a text takes: by the widths of Helvetica, which the writers make every viewer keep.
#pragma once

#include <array>
#include <string>

#include "pattern/drawing/drawing.h"

namespace dcharts {

/// A rectangle that may be turned.
struct Box {
  Point2 center{0, 0};
  Point2 half{0, 0};  ///< half its width and height, mm
  double angle = 0;   ///< radians

  Point2 AxisX() const;
  Point2 AxisY() const;
  std::array<Point2, 4> Corners() const;  ///< counterclockwise from the lower left one
  Box Grown(double by) const;
};

/// Width of a text of font size 1.
double TextWidth(const std::string& text);

/// Heights above and below the baseline of a text of font size 1.
inline constexpr double kAscent = 0.73, kDescent = 0.22, kCapHeight = 0.718;

/// The box of a text.
Box BoxOf(const Text& text);

/// The left end of the text's baseline.
Point2 BaselineStart(const Text& text);

/// The largest font size up to `size` at which the text is at most this wide.
double SizeToFit(const std::string& text, double size, double width);

/// The text as bytes of ISO 8859-1, which is what PDF's standard fonts take.
std::string Latin1(const std::string& utf8);

}  // namespace dcharts
