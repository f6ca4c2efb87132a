// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/extend_map.h"

#include <cmath>

#include <gtest/gtest.h>

namespace dcharts {
namespace {

// A strip of n by m squares, rolled onto a cylinder of radius r (0: flat) around the y axis.
ChartMesh Strip(int n, int m, double r) {
  ChartMesh mesh;
  mesh.positions.resize((n + 1) * (m + 1), 3);
  mesh.triangles.resize(2 * n * m, 3);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      const Eigen::RowVector3d flat(i, j, 0),
          bent(r * std::sin(i / (r > 0 ? r : 1)), j, r - r * std::cos(i / (r > 0 ? r : 1)));
      mesh.positions.row(i * (m + 1) + j) = r > 0 ? bent : flat;
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const int a = i * (m + 1) + j, b = a + m + 1;
      mesh.triangles.row(2 * (i * m + j)) << a, b, b + 1;
      mesh.triangles.row(2 * (i * m + j) + 1) << a, b + 1, a + 1;
    }
  return mesh;
}

// The first columns are on the map, as they would lie flat.
MapEdge Begun(const ChartMesh& mesh, int m, int columns) {
  MapEdge edge;
  edge.mesh = mesh;
  const int count = static_cast<int>(mesh.positions.rows());
  edge.placed.assign(count, false);
  edge.uv.resize(count);
  for (int v = 0; v < columns * (m + 1); ++v) {
    edge.placed[v] = true;
    edge.uv[v] = Complex(v / (m + 1), v % (m + 1));
  }
  edge.fixed = edge.placed;
  return edge;
}

TEST(ExtendMap, APlaneGoesOnExactly) {
  const int m = 4;
  MapEdge edge = Begun(Strip(8, m, 0), m, 2);
  for (double excess : ExtendMap(edge)) EXPECT_NEAR(excess, 0, 1e-12);
  for (int v = 0; v < static_cast<int>(edge.uv.size()); ++v) {
    EXPECT_TRUE(edge.placed[v]);
    EXPECT_NEAR(std::abs(edge.uv[v] - Complex(v / (m + 1), v % (m + 1))), 0, 1e-9);
  }
}

TEST(ExtendMap, ACylinderUnrolls) {
  MapEdge edge = Begun(Strip(20, 4, 10), 4, 2);
  // Chords are shorter than the arcs that the fixed columns are laid out by.
  for (double excess : ExtendMap(edge)) EXPECT_LT(excess, 1e-4);
}

TEST(ExtendMap, ABendAcrossTheWayCostsStretch) {
  // A strip that is on the map along one side, and beside it turns up by a dome: no flat way to go on.
  ChartMesh mesh = Strip(8, 8, 0);
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    const double x = mesh.positions(v, 0) - 4, y = mesh.positions(v, 1) - 4;
    if (mesh.positions(v, 0) > 1) mesh.positions(v, 2) = 0.12 * (16 - x * x) * (16 - y * y) / 16;
  }
  MapEdge edge = Begun(mesh, 8, 2);
  double worst = 0;
  for (double excess : ExtendMap(edge)) worst = std::max(worst, excess);
  EXPECT_GT(worst, 0.01);
  EXPECT_TRUE(std::isfinite(worst));
}

TEST(ExtendMap, WhatIsNotFixedMakesRoom) {
  const int m = 8;
  const ChartMesh mesh = Strip(8, m, 0);
  auto total = [&](int fixed_columns) {
    MapEdge edge = Begun(mesh, m, 2);
    for (int v = m + 1; v < 2 * (m + 1); ++v)  // the second column is drawn out
      edge.uv[v].imag(4 + 1.2 * (edge.uv[v].imag() - 4));
    for (int v = fixed_columns * (m + 1); v < static_cast<int>(edge.fixed.size()); ++v) edge.fixed[v] = false;
    double sum = 0;
    for (double excess : ExtendMap(edge)) sum += excess;
    return sum;
  };
  EXPECT_GT(total(2), 0.1);
  EXPECT_LT(total(1), 0.9 * total(2));
}

TEST(ExtendMap, WhatNoEdgeLeadsToHasNoPlace) {
  ChartMesh two = Strip(2, 1, 0);
  two.triangles.conservativeResize(3, 3);  // the last triangle but one hangs on a corner only
  two.triangles.row(1) << 0, 1, 3;
  two.triangles.row(2) << 4, 5, 3;
  MapEdge edge;
  edge.mesh = two;
  edge.placed = edge.fixed = {true, true, true, false, false, false};
  edge.uv = {{0, 0}, {0, 1}, {1, 0}, {0, 0}, {0, 0}, {0, 0}};
  const std::vector<double> excess = ExtendMap(edge);
  EXPECT_TRUE(std::isfinite(excess[0]));
  EXPECT_TRUE(edge.placed[3]);
  EXPECT_TRUE(std::isinf(excess[2]));
  EXPECT_FALSE(edge.placed[4]);
}

TEST(DirichletExcess, KnownMaps) {
  const Eigen::Vector3d e1(2, 0, 0), e2(0, 1, 0), none(4, 0, 0);
  const Complex turn = std::polar(1.0, 0.7), z1 = 2.0 * turn, z2 = Complex(0, 1) * turn;
  EXPECT_NEAR(DirichletExcess(e1, e2, z1, z2), 0, 1e-12);
  EXPECT_NEAR(DirichletExcess(e1, e2, 2.0 * z1, 2.0 * z2), (4 + 4 + 0.25 + 0.25) / 4 - 1, 1e-12);
  EXPECT_NEAR(DirichletExcess(e1, e2, 2.0 * z1, z2), (4 + 1 + 0.25 + 1) / 4 - 1, 1e-12);
  EXPECT_TRUE(std::isinf(DirichletExcess(e1, e2, z2, z1)));
  EXPECT_EQ(DirichletExcess(e1, none, z1, z2), 0);
}

}  // namespace
}  // namespace dcharts
