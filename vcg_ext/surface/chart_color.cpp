// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "surface/charts.h"

namespace dcharts {

std::array<std::uint8_t, 3> ChartColor(int id) {
  if (id < 0) return {110, 110, 110};
  // Golden-angle hues never come close for ids that are; three tones keep a long list apart.
  constexpr double kGoldenAngle = 0.6180339887498949;
  const double hue = 6 * std::fmod(0.08 + id * kGoldenAngle, 1.0);
  const double saturation = id % 3 == 1 ? 0.38 : 0.58;
  const double value = id % 3 == 2 ? 0.78 : 0.96;
  auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue, 6.0);
    const double level = value - value * saturation * std::fmax(0.0, std::fmin(std::fmin(k, 4 - k), 1.0));
    return static_cast<std::uint8_t>(std::lround(255 * level));
  };
  return {channel(5), channel(3), channel(1)};
}

}  // namespace dcharts
