// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

namespace dcharts {

/// Chart id per face, 0..n-1; kUnassigned while no chart has taken the face.
using ChartIds = std::vector<int>;
constexpr int kUnassigned = -1;

inline int ChartCount(const ChartIds& ids) {
  int count = 0;
  for (int id : ids) count = std::max(count, id + 1);
  return count;
}

}  // namespace dcharts
