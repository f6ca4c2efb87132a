// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/face_order.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace dcharts {
namespace {

using Point = std::array<double, 3>;

// Of the face; sums of large coordinates would overflow.
Point Corner(const SurfaceData& data, int face) { return data.vertices[data.faces[face][0]]; }

// Bits of three cell numbers in turn.
std::uint64_t ZOrder(const std::array<std::uint32_t, 3>& cell) {
  constexpr int kBits = 12;
  std::uint64_t code = 0;
  for (int bit = kBits - 1; bit >= 0; --bit)
    for (int d = 0; d < 3; ++d) code = code << 1 | (cell[d] >> bit & 1);
  return code;
}

}  // namespace

void SortForMemory(const SurfaceData& data, std::vector<int>& faces) {
  constexpr size_t kManyFaces = 100000;
  if (faces.size() <= kManyFaces) return;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (int f : faces)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], Corner(data, f)[d]);
      high[d] = std::max(high[d], Corner(data, f)[d]);
    }
  double size = 0;
  for (int d = 0; d < 3; ++d) size = std::max(size, high[d] / 2 - low[d] / 2);
  if (!(size > 0)) return;
  std::vector<std::pair<std::uint64_t, int>> order;
  order.reserve(faces.size());
  for (int f : faces) {
    std::array<std::uint32_t, 3> cell{};
    for (int d = 0; d < 3; ++d) {
      constexpr double kCells = 4095;
      cell[d] = static_cast<std::uint32_t>((Corner(data, f)[d] / 2 - low[d] / 2) / size * kCells);
    }
    order.push_back({ZOrder(cell), f});
  }
  std::sort(order.begin(), order.end());
  for (size_t k = 0; k < faces.size(); ++k) faces[k] = order[k].second;
}

}  // namespace dcharts
