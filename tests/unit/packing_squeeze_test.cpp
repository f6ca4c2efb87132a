// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/packing_squeeze.h"

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace dcharts {
namespace {

RowRuns Shape(const std::vector<Run>& rows) {
  RowRuns cells;
  for (const Run& run : rows) {
    cells.rows.push_back({run});
    cells.width = std::max(cells.width, run.last + 1);
  }
  return cells;
}

RowRuns Box(int width, int height) {
  return Shape(std::vector<Run>(static_cast<size_t>(height), Run{0, width - 1}));
}

// A right triangle and the one that makes a box of it: each is the other, turned.
std::vector<RowRuns> Triangle(int size) {
  std::vector<Run> lower, upper;
  for (int r = 0; r < size; ++r) {
    lower.push_back({0, size - 1 - r});
    upper.push_back({size - 1 - r, size - 1});
  }
  return {Shape(lower), Shape(upper)};
}

// Within the square, and no cell taken twice.
void ExpectSound(const std::vector<std::vector<RowRuns>>& shapes, const std::vector<Spot>& spots, int side) {
  std::vector<int> taken(static_cast<size_t>(side) * static_cast<size_t>(side), 0);
  for (size_t k = 0; k < spots.size(); ++k) {
    const RowRuns& cells = shapes[k][static_cast<size_t>(spots[k].turn)];
    ASSERT_GE(std::min(spots[k].x, spots[k].y), 0);
    ASSERT_LE(spots[k].x + cells.width, side);
    ASSERT_LE(spots[k].y + cells.Height(), side);
    for (int r = 0; r < cells.Height(); ++r)
      for (const Run& run : cells.rows[static_cast<size_t>(r)])
        for (int c = run.first; c <= run.last; ++c)
          EXPECT_EQ(taken[static_cast<size_t>((spots[k].y + r) * side + spots[k].x + c)]++, 0) << k;
  }
}

TEST(PackingSqueeze, FourBoxesThatOverlapFillASquare) {
  const std::vector<std::vector<RowRuns>> shapes(4, {Box(20, 20)});
  std::vector<Spot> spots(4);
  EXPECT_EQ(Squeeze(shapes, 60, 3000, 0, {}, &spots), 40);
  ExpectSound(shapes, spots, 40);
}

TEST(PackingSqueeze, TrianglesTurnToNest) {
  const std::vector<std::vector<RowRuns>> shapes(2, Triangle(20));
  std::vector<Spot> spots(2);
  EXPECT_EQ(Squeeze(shapes, 45, 3000, 0, {}, &spots), 21);
  ExpectSound(shapes, spots, 21);
  EXPECT_NE(spots[0].turn, spots[1].turn);
}

TEST(PackingSqueeze, WhatDoesNotFitStaysAsItWas) {
  const std::vector<std::vector<RowRuns>> shapes{{Box(10, 10)}, {Box(30, 5)}, {Box(10, 10)}};
  std::vector<Spot> spots{{0, 1, 2}, {0, 3, 4}, {0, 5, 6}};
  EXPECT_EQ(Squeeze(shapes, 20, 500, 0, {}, &spots), 0);
  EXPECT_EQ(spots[1].x, 3);
  EXPECT_EQ(spots[2].y, 6);
}

TEST(PackingSqueeze, SameInputSameResult) {
  std::mt19937 random(5);
  std::vector<std::vector<RowRuns>> shapes;
  for (int k = 0; k < 12; ++k)
    shapes.push_back({Box(5 + static_cast<int>(random() % 20), 5 + static_cast<int>(random() % 20))});
  std::vector<Spot> a(12), b(12);
  const int side = Squeeze(shapes, 90, 1000, 0, {}, &a);
  EXPECT_GT(side, 0);
  EXPECT_EQ(Squeeze(shapes, 90, 1000, 0, {}, &b), side);
  for (size_t k = 0; k < 12; ++k) EXPECT_TRUE(a[k].x == b[k].x && a[k].y == b[k].y) << k;
  ExpectSound(shapes, a, side);
}

TEST(PackingSqueeze, EndsAlsoWhereNothingCanMove) {
  // Three boxes that fill the square each: no move helps, and none makes the square smaller.
  const std::vector<std::vector<RowRuns>> shapes(3, {Box(20, 20)});
  std::vector<Spot> spots(3);
  int polls = 0;
  EXPECT_EQ(Squeeze(
                shapes, 20, 500, 0, [&] { ++polls; }, &spots),
            0);
  EXPECT_LE(polls, 500);
  // And one alone shrinks the square to itself, then can't fit.
  std::vector<Spot> one(1);
  EXPECT_EQ(Squeeze({{Box(20, 20)}}, 40, 500, 0, {}, &one), 20);
}

TEST(PackingSqueeze, PollMayStopIt) {
  const std::vector<std::vector<RowRuns>> shapes(4, {Box(20, 20)});
  std::vector<Spot> spots(4);
  EXPECT_THROW(Squeeze(
                   shapes, 60, 3000, 0, [] { throw 1; }, &spots),
               int);
}

}  // namespace
}  // namespace dcharts
