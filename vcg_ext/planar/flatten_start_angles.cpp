// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/flatten_start_angles.h"

#include "planar/abf.h"

namespace dcharts {

std::optional<PlanePoints> StartFromAngles(const ChartMesh& chart, const RestShapes& shapes, int angle_steps,
                                           VertexBlockSystem& system) {
  constexpr double kSmallestAngle = 0.035;  // about 2 degrees: a few steps must not get lost in slivers
  AngleFlattening flattening(chart, shapes, kSmallestAngle);
  for (int step = 0; step < angle_steps; ++step) {
    if (!flattening.Step(system)) return std::nullopt;
  }
  return flattening.LayOut(system);
}

}  // namespace dcharts
