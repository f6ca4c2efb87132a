// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "planar/complex_plane.h"

namespace dcharts {

/// A spring that draws a vertex along one direction.
struct VertexPull {
  std::size_t vertex = 0;
  Complex direction;     ///< unit length
  double target = 0;     ///< where along the direction
  double stiffness = 0;  ///< beside a map's energy for a chart of area 1

  double Off(const PlanePoints& uv) const { return Dot(direction, uv[vertex]) - target; }
};
using VertexPulls = std::vector<VertexPull>;

inline double PullEnergy(const VertexPulls& pulls, const PlanePoints& uv) {
  double sum = 0;
  for (const VertexPull& pull : pulls) sum += 0.5 * pull.stiffness * pull.Off(uv) * pull.Off(uv);
  return sum;
}

}  // namespace dcharts
