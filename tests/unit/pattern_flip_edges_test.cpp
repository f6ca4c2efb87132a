// SPDX-License-Identifier: GPL-3.0-or-later
/// Flipping edges between parts of one face.
#include <gtest/gtest.h>

#include <set>

#include "pattern/flip_edges.h"

namespace dcharts {
namespace {

// Two narrow triangles along the edge from vertex 0 to 1; the other diagonal, from 2 to 3, is the short one.
FlatChart Kite(double height_of_last) {
  FlatChart chart;
  chart.uv.resize(4, 2);
  chart.uv << 0, 0, 10, 0, 5, 1, 5, -1;
  chart.mesh.positions.resize(4, 3);
  chart.mesh.positions << 0, 0, 0, 10, 0, 0, 5, 1, 0, 5, -1, height_of_last;
  chart.mesh.triangles.resize(2, 3);
  chart.mesh.triangles << 0, 1, 2, 1, 0, 3;
  chart.source_face = {7, 7};
  chart.model_vertex = {0, 1, 2, 3};
  return chart;
}

bool HasEdge(const FlatChart& chart, int a, int b) {
  for (int h = 0; h < 3 * chart.mesh.triangles.rows(); ++h)
    if (StartOf(chart, h) == a && EndOf(chart, h) == b) return true;
  return false;
}

void ExpectTurnedAsBefore(const FlatChart& chart) {
  for (Eigen::Index f = 0; f < chart.mesh.triangles.rows(); ++f) {
    const auto at = [&](int k) -> Eigen::RowVector2d { return chart.uv.row(chart.mesh.triangles(f, k)); };
    const Eigen::RowVector2d a = at(1) - at(0), b = at(2) - at(0);
    EXPECT_NEAR(a.x() * b.y() - a.y() * b.x(), 10, 1e-12);  // half of the kite each
  }
}

TEST(FlipEdges, TheShortDiagonalIsTaken) {
  FlatChart chart = Kite(0);
  FlipEdges({}, chart);
  EXPECT_TRUE(HasEdge(chart, 2, 3) && HasEdge(chart, 3, 2));
  EXPECT_FALSE(HasEdge(chart, 0, 1) || HasEdge(chart, 1, 0));
  ExpectTurnedAsBefore(chart);
}

TEST(FlipEdges, ACutStays) {
  FlatChart chart = Kite(0);
  FlipEdges({{1, 0}}, chart);
  EXPECT_TRUE(HasEdge(chart, 0, 1) && HasEdge(chart, 1, 0));
}

TEST(FlipEdges, AnEdgeBetweenFacesStays) {
  FlatChart chart = Kite(0);
  chart.source_face[1] = 8;
  FlipEdges({}, chart);
  EXPECT_TRUE(HasEdge(chart, 0, 1) && HasEdge(chart, 1, 0));
}

TEST(FlipEdges, AFoldStays) {
  FlatChart chart = Kite(0.1);
  FlipEdges({}, chart);
  EXPECT_TRUE(HasEdge(chart, 0, 1) && HasEdge(chart, 1, 0));
}

// A fan of needles, as cuts leave it: all corners on the outline of a square.
TEST(FlipEdges, AFanIsOpened) {
  constexpr int kPoints = 40;
  FlatChart chart;
  chart.uv.resize(kPoints + 2, 2);
  chart.mesh.positions.resize(kPoints + 2, 3);
  for (int k = 0; k <= kPoints; ++k) chart.uv.row(k) << k, (k % 2 == 0 ? 40 : 41);
  chart.uv.row(kPoints + 1) << 0, 0;
  chart.mesh.positions << chart.uv, Eigen::VectorXd::Zero(kPoints + 2);
  chart.mesh.triangles.resize(kPoints, 3);
  for (int k = 0; k < kPoints; ++k) chart.mesh.triangles.row(k) << kPoints + 1, k + 1, k;
  chart.source_face.assign(kPoints, 0);
  chart.model_vertex.resize(kPoints + 2);
  FlipEdges({}, chart);
  std::set<std::set<int>> corners;
  int at_apex = 0;
  for (Eigen::Index f = 0; f < kPoints; ++f) {
    const auto at = [&](int k) -> Eigen::RowVector2d { return chart.uv.row(chart.mesh.triangles(f, k)); };
    const Eigen::RowVector2d a = at(1) - at(0), b = at(2) - at(0);
    EXPECT_GT(a.x() * b.y() - a.y() * b.x(), 0);
    corners.insert({chart.mesh.triangles(f, 0), chart.mesh.triangles(f, 1), chart.mesh.triangles(f, 2)});
    for (int k = 0; k < 3; ++k) at_apex += chart.mesh.triangles(f, k) == kPoints + 1 ? 1 : 0;
  }
  EXPECT_EQ(corners.size(), static_cast<size_t>(kPoints));
  EXPECT_LT(at_apex, kPoints * 3 / 4);
}

}  // namespace
}  // namespace dcharts
