// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/outline_loops.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace dcharts {
namespace {

using Loop = std::vector<Eigen::Vector2d>;

Points2 Edges(const std::vector<Loop>& loops) {
  Eigen::Index row = 0;
  for (const Loop& loop : loops) row += 2 * static_cast<Eigen::Index>(loop.size());
  Points2 outline(row, 2);
  row = 0;
  for (const Loop& loop : loops)
    for (size_t k = 0; k < loop.size(); ++k) {
      outline.row(row++) = loop[k];
      outline.row(row++) = loop[(k + 1) % loop.size()];
    }
  return outline;
}

double SignedArea(const Loop& loop) {
  double twice = 0;
  for (size_t k = 0; k < loop.size(); ++k) {
    const Eigen::Vector2d &a = loop[k], &b = loop[(k + 1) % loop.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

Loop Square(double side, double x, double y) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

TEST(OutlineLoops, ALoopRunsCounterclockwiseAndAHoleClockwise) {
  std::vector<Loop> loops;
  // Both given either way.
  for (int way = 0; way < 4; ++way) {
    Loop outer = Square(10, 0, 0), hole = Square(2, 4, 4);
    if (way % 2) std::swap(outer[1], outer[3]);
    if (way / 2) std::swap(hole[1], hole[3]);
    ASSERT_TRUE(OutlineLoops(Edges({outer, hole}), &loops)) << way;
    ASSERT_EQ(loops.size(), 2u);
    const bool outer_first = std::abs(SignedArea(loops[0])) > 50;
    EXPECT_EQ(SignedArea(loops[outer_first ? 0 : 1]), 100) << way;
    EXPECT_EQ(SignedArea(loops[outer_first ? 1 : 0]), -4) << way;
  }
}

TEST(OutlineLoops, EdgesInAnyOrderAndWithoutLength) {
  Points2 outline(10, 2);
  outline << 1, 1, 0, 1, /**/ 0, 0, 1, 0, /**/ 1, 0, 1, 0, /**/ 0, 1, 0, 0, /**/ 1, 0, 1, 1;
  std::vector<Loop> loops;
  ASSERT_TRUE(OutlineLoops(outline, &loops));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 4u);
  EXPECT_EQ(SignedArea(loops[0]), 1);
}

TEST(OutlineLoops, WhatDoesNotCloseIsRefused) {
  Points2 open(4, 2), point(2, 2);
  open << 0, 0, 1, 0, 1, 0, 1, 1;
  point << 2, 2, 2, 2;
  std::vector<Loop> loops;
  EXPECT_FALSE(OutlineLoops(open, &loops));
  EXPECT_FALSE(OutlineLoops(point, &loops));
}

TEST(Simplified, StaysWithinTheTolerance) {
  constexpr double kStep = 2 * 3.14159265358979323846 / 500;
  Loop circle;
  for (int k = 0; k < 500; ++k) circle.emplace_back(std::cos(k * kStep), std::sin(k * kStep));
  const Loop simple = Simplified(circle, 0.01);
  EXPECT_LT(simple.size(), 50u);
  for (const Eigen::Vector2d& p : circle) {
    double nearest = 9;
    for (size_t k = 0; k < simple.size(); ++k) {
      const Eigen::Vector2d a = simple[k], e = simple[(k + 1) % simple.size()] - a;
      const double t = std::min(1.0, std::max(0.0, (p - a).dot(e) / e.squaredNorm()));
      nearest = std::min(nearest, (p - a - t * e).norm());
    }
    EXPECT_LE(nearest, 0.01 + 1e-12);
  }
}

TEST(Simplified, CornersOnALineGo) {
  Loop square;
  for (const Eigen::Vector2d& step : Square(1, 0, 0)) square.push_back(10 * step);
  Loop fine;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 10; ++i) fine.push_back(square[k] + 0.1 * i * (square[(k + 1) % 4] - square[k]));
  const Loop simple = Simplified(fine, 1e-9);
  EXPECT_EQ(simple.size(), 4u);
  EXPECT_NEAR(SignedArea(simple), 100, 1e-9);
}

}  // namespace
}  // namespace dcharts
