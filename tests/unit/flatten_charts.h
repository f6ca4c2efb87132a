// SPDX-License-Identifier: GPL-3.0-or-later
/// Charts built in code for the tests of flattening.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "planar/chart_mesh.h"

namespace dcharts {

constexpr double kTestPi = 3.14159265358979323846;

using Surface = std::function<Eigen::RowVector3d(double, double)>;

/// `columns` x `rows` quads over [0,1]^2, cut by alternating diagonals and mapped by `surface`. Quads for
/// which `keep` is false are left out.
inline ChartMesh GridChart(int columns, int rows, const Surface& surface,
                           const std::function<bool(int, int)>& keep = {}) {
  std::vector<int> vertex_of(static_cast<std::size_t>((columns + 1) * (rows + 1)), -1);
  std::vector<Eigen::RowVector3d> positions;
  std::vector<std::array<int, 3>> triangles;
  const auto vertex = [&](int i, int j) {
    int& v = vertex_of[static_cast<std::size_t>(i * (rows + 1) + j)];
    if (v < 0) {
      v = static_cast<int>(positions.size());
      positions.push_back(surface(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
    }
    return v;
  };
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      if (keep && !keep(i, j)) continue;
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      if ((i + j) % 2 == 0) {
        triangles.push_back({a, b, d});
        triangles.push_back({b, c, d});
      } else {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      }
    }
  }
  ChartMesh chart;
  chart.positions.resize(static_cast<Eigen::Index>(positions.size()), 3);
  chart.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    chart.positions.row(static_cast<Eigen::Index>(v)) = positions[v];
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    chart.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return chart;
}

inline Eigen::RowVector3d PlanePoint(double x, double y) { return {2 * x, y, 0}; }

/// A gently curved sheet that isn't developable.
inline Eigen::RowVector3d SaddlePoint(double x, double y) { return {x, y, 0.6 * (x - 0.5) * (y - 0.4)}; }

/// A unit sphere from its pole down to the polar angle `opening`, as a grid bent to a disk.
inline ChartMesh SphereCap(int quads, double opening) {
  return GridChart(quads, quads, [opening](double x, double y) -> Eigen::RowVector3d {
    const double a = 2 * x - 1, b = 2 * y - 1;
    const double u = a * std::sqrt(1 - b * b / 2), v = b * std::sqrt(1 - a * a / 2);
    const double r = std::hypot(u, v), angle = r * opening;
    if (r == 0) return {0, 0, 1};
    return {u / r * std::sin(angle), v / r * std::sin(angle), std::cos(angle)};
  });
}

/// A tube of `rings` rings of `around` vertices each; `closed` adds a tip behind the last ring.
inline ChartMesh Tube(int around, int rings, bool closed,
                      const std::function<Eigen::RowVector3d(double angle, int ring)>& surface) {
  ChartMesh chart;
  const int tip = around * rings;
  chart.positions.resize(tip + (closed ? 1 : 0), 3);
  chart.triangles.resize(2 * around * (rings - 1) + (closed ? around : 0), 3);
  for (int ring = 0; ring < rings; ++ring) {
    for (int step = 0; step < around; ++step) {
      chart.positions.row(ring * around + step) = surface(2 * kTestPi * step / around, ring);
    }
  }
  Eigen::Index t = 0;
  for (int ring = 0; ring + 1 < rings; ++ring) {
    for (int step = 0; step < around; ++step) {
      const int a = ring * around + step, b = ring * around + (step + 1) % around;
      chart.triangles.row(t++) << a, b, b + around;
      chart.triangles.row(t++) << a, b + around, a + around;
    }
  }
  if (closed) {
    chart.positions.row(tip) =
        chart.positions.middleRows((rings - 1) * around, around).colwise().mean() +
        Eigen::RowVector3d(0, 0, (chart.positions.row(around) - chart.positions.row(0)).norm());
    for (int step = 0; step < around; ++step) {
      const int a = (rings - 1) * around;
      chart.triangles.row(t++) << a + step, a + (step + 1) % around, tip;
    }
  }
  return chart;
}

}  // namespace dcharts
