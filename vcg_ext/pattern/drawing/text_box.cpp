// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/text_box.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dcharts {

namespace {

// Helvetica's widths of the characters 32 to 126, in thousandths (Adobe's font metrics).
constexpr std::array<int, 95> kWidths = {
    278,  278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,  // space to /
    556,  556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,  // 0 to ?
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,  // @ to O
    667,  778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,  // P to _
    333,  556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,  // ` to o
    556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};      // p to ~
constexpr int kOtherWidth = 400;                                                      // the degree sign

}  // namespace

Point2 Box::AxisX() const { return {std::cos(angle), std::sin(angle)}; }

Point2 Box::AxisY() const { return {-std::sin(angle), std::cos(angle)}; }

std::array<Point2, 4> Box::Corners() const {
  const Point2 x = half.x() * AxisX(), y = half.y() * AxisY();
  return {center - x - y, center + x - y, center + x + y, center - x + y};
}

Box Box::Grown(double by) const { return {center, half + Point2(by, by), angle}; }

double TextWidth(const std::string& text) {
  int sum = 0;
  for (unsigned char c : Latin1(text)) sum += c >= 32 && c <= 126 ? kWidths[c - 32] : kOtherWidth;
  return sum / 1000.0;
}

Box BoxOf(const Text& text) {
  return {text.at, {TextWidth(text.text) * text.size / 2, (kAscent + kDescent) * text.size / 2}, text.angle};
}

Point2 BaselineStart(const Text& text) {
  const Box box = BoxOf(text);
  return box.center - box.half.x() * box.AxisX() - (kAscent - kDescent) / 2 * text.size * box.AxisY();
}

double SizeToFit(const std::string& text, double size, double width) {
  return std::min(size, width / std::max(TextWidth(text), 1e-9));
}

std::string Latin1(const std::string& utf8) {
  std::string bytes;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto c = static_cast<unsigned char>(utf8[i]);
    if (c < 0x80) {
      bytes += utf8[i];
    } else if ((c == 0xC2 || c == 0xC3) && i + 1 < utf8.size()) {
      bytes += static_cast<char>(((c & 3) << 6) | (static_cast<unsigned char>(utf8[++i]) & 0x3F));
    } else if (c >= 0xC0) {
      bytes += '?';  // followed by bytes below 0xC0, which are left out
    }
  }
  return bytes;
}

}  // namespace dcharts
