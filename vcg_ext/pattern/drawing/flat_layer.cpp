// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/flat_layer.h"

#include <algorithm>
#include <cmath>

namespace dcharts {

std::array<std::uint8_t, 3> PieceColor(int piece) {
  // Golden-angle hues never come close for pieces that are; two tones keep a long list apart.
  constexpr double kGoldenAngle = 0.6180339887498949;
  const double hue = 6 * std::fmod(0.08 + piece * kGoldenAngle, 1.0);
  const double saturation = piece % 2 == 0 ? 0.5 : 0.3;
  std::array<std::uint8_t, 3> rgb;
  for (int c = 0; c < 3; ++c) {
    const double k = std::fmod(5.0 - 2 * c + hue, 6.0);
    const double level = 1 - saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    rgb[c] = static_cast<std::uint8_t>(std::lround(255 * level));
  }
  return rgb;
}

FlatLayer LayerOf(const Pattern& pattern) {
  FlatLayer layer;
  for (const Piece& piece : pattern.pieces) {
    if (!piece.drawn) continue;
    const int first = static_cast<int>(layer.vertices.size());
    for (const Point2& p : piece.net.vertices) {
      const Point2 placed = piece.on_sheet(p);
      layer.vertices.push_back({placed.x(), placed.y(), 0});
    }
    for (const auto& triangle : piece.net.triangles) {
      layer.faces.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
      layer.piece.push_back(piece.id);
      layer.colors.push_back(PieceColor(piece.id));
    }
  }
  return layer;
}

}  // namespace dcharts
