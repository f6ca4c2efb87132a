// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/grain.h"

#include <algorithm>
#include <limits>

#include "pattern/segments.h"

namespace dcharts {

void SetGrain(const FlatCharts& charts, Pattern& pattern) {
  Point3 low = Point3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const FlatChart& chart : charts.charts) {
    low = low.cwiseMin(chart.mesh.positions.colwise().minCoeff().transpose());
    high = high.cwiseMax(chart.mesh.positions.colwise().maxCoeff().transpose());
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  for (Piece& piece : pattern.pieces) {
    const FlatChart& chart = charts.charts[piece.id];
    // The sum over triangles of area times gradient of the height along the axis.
    Point2 climb(0, 0);
    double area = 0;
    for (Eigen::Index t = 0; t < chart.mesh.triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int v = chart.mesh.triangles(t, k), a = chart.mesh.triangles(t, (k + 1) % 3),
                  b = chart.mesh.triangles(t, (k + 2) % 3);
        const Eigen::RowVector2d e = chart.uv.row(b) - chart.uv.row(a);
        climb += chart.mesh.positions(v, axis) * Point2(-e.y(), e.x()) / 2;
      }
      area += Orient(chart.uv.row(chart.mesh.triangles(t, 0)), chart.uv.row(chart.mesh.triangles(t, 1)),
                     chart.uv.row(chart.mesh.triangles(t, 2))) /
              2;
    }
    constexpr double kFlat = 0.05;  // climbs less than this per length: any direction will do
    if (climb.norm() > kFlat * std::abs(area)) piece.grain = climb.normalized();
  }
}

}  // namespace dcharts
