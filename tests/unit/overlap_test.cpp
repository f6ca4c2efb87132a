// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/overlap.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "flatten_charts.h"
#include "thread_count.h"

namespace dcharts {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

Pairs BruteForce(const std::vector<GridTriangle>& triangles) {
  Pairs pairs;
  for (int i = 0; i < static_cast<int>(triangles.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(triangles.size()); ++j) {
      test::GridUv a, b;
      std::copy(triangles[i].begin(), triangles[i].end(), a.begin());
      std::copy(triangles[j].begin(), triangles[j].end(), b.begin());
      if (test::InteriorsMeet(a, b)) pairs.push_back({i, j});
    }
  return pairs;
}

std::vector<GridTriangle> RandomTriangles(unsigned seed, int count, std::int32_t range, std::int32_t size) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::int32_t> place(-range, range), offset(-size, size);
  std::vector<GridTriangle> triangles;
  for (int k = 0; k < count; ++k) {
    const std::int32_t x = place(random), y = place(random);
    GridTriangle t;
    for (int i = 0; i < 3; ++i) {
      t[2 * i] = x + offset(random);
      t[2 * i + 1] = y + offset(random);
    }
    triangles.push_back(t);
  }
  return triangles;
}

const GridTriangle kTriangle = {0, 0, 10, 0, 0, 10};

// Overlap() in both orders and all orientations.
bool OverlapAnyWay(GridTriangle a, GridTriangle b) {
  const bool result = Overlap(a, b);
  EXPECT_EQ(Overlap(b, a), result);
  std::swap(a[0], a[2]);
  std::swap(a[1], a[3]);
  EXPECT_EQ(Overlap(a, b), result);
  std::swap(b[2], b[4]);
  std::swap(b[3], b[5]);
  EXPECT_EQ(Overlap(a, b), result);
  EXPECT_EQ(Overlap(b, a), result);
  return result;
}

TEST(Overlap, TwiceAreaIsSigned) {
  EXPECT_EQ(TwiceArea(kTriangle), 100);
  EXPECT_EQ(TwiceArea({0, 0, 0, 10, 10, 0}), -100);
  EXPECT_EQ(TwiceArea({0, 0, 5, 5, 10, 10}), 0);
}

TEST(Overlap, TwiceAreaDoesNotOverflowAtTheGridsEnds) {
  const std::int32_t e = 1 << 30;
  EXPECT_EQ(TwiceArea({-e, -e, e, -e, -e, e}), std::int64_t(1) << 62);
}

TEST(Overlap, ApartOrTouchingIsNone) {
  EXPECT_FALSE(OverlapAnyWay(kTriangle, {20, 20, 30, 20, 20, 30}));
  EXPECT_FALSE(OverlapAnyWay(kTriangle, {0, 0, -10, 0, 0, -10})) << "a shared vertex";
  EXPECT_FALSE(OverlapAnyWay(kTriangle, {10, 0, 10, 10, 0, 10})) << "a shared edge";
  EXPECT_FALSE(OverlapAnyWay(kTriangle, {5, 0, 3, -4, 8, -4})) << "a vertex on an edge";
  EXPECT_FALSE(OverlapAnyWay(kTriangle, {2, 0, 7, 0, 4, -9})) << "a part of an edge";
  EXPECT_FALSE(OverlapAnyWay(kTriangle, {-5, 0, 25, 0, 4, -9})) << "an edge and more";
}

TEST(Overlap, AnyCommonInteriorIsOne) {
  EXPECT_TRUE(OverlapAnyWay(kTriangle, kTriangle)) << "the same";
  EXPECT_TRUE(OverlapAnyWay(kTriangle, {2, 2, 3, 2, 2, 3})) << "one within the other";
  EXPECT_TRUE(OverlapAnyWay(kTriangle, {0, 0, 10, 0, 3, 3})) << "a shared edge, the same side";
  EXPECT_TRUE(OverlapAnyWay(kTriangle, {-5, 2, 20, 2, 20, 3})) << "no vertex in the other";
  EXPECT_TRUE(OverlapAnyWay(kTriangle, {0, 0, 20, 1, 1, 20})) << "a shared vertex, the same side";
}

TEST(Overlap, OneGridStepDecides) {
  EXPECT_FALSE(OverlapAnyWay(kTriangle, {0, 10, 10, 0, 10, 10}));
  EXPECT_TRUE(OverlapAnyWay(kTriangle, {0, 10, 10, -1, 10, 10}));
  EXPECT_TRUE(OverlapAnyWay(kTriangle, {0, 9, 10, 0, 10, 10}));
  // At the grid's full size, where doubles would round.
  const std::int32_t e = 1 << 30;
  const GridTriangle big = {-e, -e, e, e, -e, e};
  EXPECT_FALSE(OverlapAnyWay(big, {-e, -e, e, -e, e, e}));
  EXPECT_FALSE(OverlapAnyWay(big, {-e, -e, e, -e, e - 1, e - 1}));
  EXPECT_TRUE(OverlapAnyWay(big, {-e, -e, e, -e, e - 1, e}));
}

TEST(Overlap, TriangleWithoutAreaOverlapsNothing) {
  EXPECT_FALSE(OverlapAnyWay(kTriangle, {1, 1, 2, 2, 3, 3}));
  EXPECT_FALSE(OverlapAnyWay(kTriangle, {1, 1, 1, 1, 1, 1}));
  EXPECT_FALSE(OverlapAnyWay({0, 0, 1, 1, 2, 2}, {0, 0, 1, 1, 2, 2}));
}

TEST(Overlap, AgreesWithProjectionOnSmallRandomTriangles) {
  // A small grid: touching and degenerate cases are frequent.
  const auto triangles = RandomTriangles(1, 300, 4, 4);
  for (size_t i = 0; i < triangles.size(); ++i)
    for (size_t j = 0; j < triangles.size(); ++j) {
      test::GridUv a, b;
      std::copy(triangles[i].begin(), triangles[i].end(), a.begin());
      std::copy(triangles[j].begin(), triangles[j].end(), b.begin());
      ASSERT_EQ(Overlap(triangles[i], triangles[j]), test::InteriorsMeet(a, b)) << i << " " << j;
    }
}

TEST(OverlappingPairs, AgreesWithBruteForce) {
  struct Case {
    int count;
    std::int32_t range, size;
  };
  unsigned seed = 7;
  for (const Case& c : {Case{0, 10, 10},
                        {1, 10, 10},
                        {2, 1, 9},
                        {300, 1000, 60},
                        {300, 20, 6},
                        {200, 0, 100},
                        {400, 1 << 29, 1 << 25},
                        {150, 1 << 29, 1 << 29}}) {
    const auto triangles = RandomTriangles(seed++, c.count, c.range, c.size);
    EXPECT_EQ(OverlappingPairs(triangles, 1000000), BruteForce(triangles))
        << c.count << " " << c.range << " " << c.size;
  }
}

TEST(OverlappingPairs, LargeAmongSmall) {
  auto triangles = RandomTriangles(3, 300, 1 << 20, 1 << 12);
  triangles.push_back({-(1 << 20), -(1 << 20), 1 << 20, -(1 << 20), 0, 1 << 20});
  triangles.push_back({-(1 << 20), 0, 1 << 20, 1, 1 << 20, 2});
  EXPECT_EQ(OverlappingPairs(triangles, 1000000), BruteForce(triangles));
}

TEST(OverlappingPairs, AllInOnePlaceOrOnOneLine) {
  const std::vector<GridTriangle> same(20, kTriangle);
  EXPECT_EQ(OverlappingPairs(same, 1000).size(), 190u);
  EXPECT_TRUE(OverlappingPairs(std::vector<GridTriangle>(20, {3, 3, 3, 3, 3, 3}), 1000).empty());
  std::vector<GridTriangle> line;
  for (int k = 0; k < 20; ++k) line.push_back({k, 0, k + 2, 0, k + 1, 0});
  EXPECT_TRUE(OverlappingPairs(line, 1000).empty());
}

TEST(OverlappingPairs, StopsAtTheLimit) {
  const std::vector<GridTriangle> same(20, kTriangle);
  for (size_t limit : {1u, 5u, 189u, 190u}) {
    const Pairs pairs = OverlappingPairs(same, limit);
    EXPECT_EQ(pairs.size(), limit);
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
    for (const auto& [i, j] : pairs) EXPECT_LT(i, j);
  }
}

TEST(OverlappingPairs, OfManyAreTheSameForAnyNumberOfThreads) {
  const std::vector<GridTriangle> triangles = RandomTriangles(5, 40000, 1 << 28, 1 << 22);
  for (size_t limit : {size_t{1}, size_t{500}, triangles.size() * 10}) {
    std::vector<Pairs> results;
    for (int count : {1, 2, 8}) {
      const test::Threads threads(count);
      results.push_back(OverlappingPairs(triangles, limit));
    }
    EXPECT_EQ(results[1], results[0]);
    EXPECT_EQ(results[2], results[0]);
    EXPECT_TRUE(std::is_sorted(results[0].begin(), results[0].end()));
    EXPECT_GE(results[0].size(), std::min<size_t>(limit, 501));
    EXPECT_LE(results[0].size(), limit);
  }
}

TEST(OverlappingPairs, FlatSheetHasNone) {
  std::vector<GridTriangle> sheet;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      sheet.push_back({i, j, i + 1, j, i + 1, j + 1});
      sheet.push_back({i, j, i + 1, j + 1, i, j + 1});
    }
  EXPECT_TRUE(OverlappingPairs(sheet, 1000).empty());
}

// What takes less time says the same: of maps of a sheet and of one with a hole, wound up by more and more.
TEST(OverlapsInMap, AgreesWithAllPairs) {
  constexpr size_t kMany = 100'000;
  int with = 0, without = 0;
  for (const bool hole : {false, true}) {
    const ChartMesh chart =
        GridChart(60, 4, PlanePoint, [&](int i, int j) { return !hole || i != 30 || j == 0 || j == 3; });
    for (const double turns : {0.0, 0.5, 0.9, 1.1, 2.0}) {
      Points2 uv(chart.positions.rows(), 2);
      for (Eigen::Index v = 0; v < uv.rows(); ++v) {
        const double angle = 2 * kTestPi * turns * chart.positions(v, 0) / 2,
                     radius = 3 - chart.positions(v, 1);
        uv.row(v) << (turns > 0 ? radius * std::sin(angle) : chart.positions(v, 0)),
            (turns > 0 ? -radius * std::cos(angle) : chart.positions(v, 1));
      }
      const Pairs all = OverlappingPairs(OnGrid(uv, chart.triangles), kMany);
      EXPECT_EQ(OverlapsInMap(uv, chart.triangles, kMany), all) << turns;
      EXPECT_EQ(OverlapsItself(uv, chart.triangles), !all.empty());
      (all.empty() ? without : with) += 1;
    }
  }
  EXPECT_EQ(without, 6);
  EXPECT_EQ(with, 4);
}

TEST(OverlapsInMap, AFlippedTriangleWithinIsFound) {
  const ChartMesh chart = GridChart(5, 5, PlanePoint);
  Points2 uv = chart.positions.leftCols<2>();
  EXPECT_FALSE(OverlapsItself(uv, chart.triangles));
  const Triangles rim = RimOf(chart.triangles);
  EXPECT_LT(rim.rows(), chart.triangles.rows());
  // A vertex in the middle that no triangle of the rim has is pulled over its neighbours.
  for (Eigen::Index v = 0; v < uv.rows(); ++v)
    if (std::abs(uv(v, 0) - 0.8) < 1e-9 && std::abs(uv(v, 1) - 0.4) < 1e-9) {
      ASSERT_EQ((rim.array() == static_cast<int>(v)).count(), 0);
      uv.row(v) << 1.3, 0.7;
    }
  EXPECT_TRUE(OverlapsItself(uv, chart.triangles));
}

TEST(OnGrid, KeepsShapeAndSharedVertices) {
  Points2 uv(4, 2);
  uv << 3, 5, 7, 5, 7, 7, 3, 7;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const auto grid = OnGrid(uv, triangles);
  const std::int32_t n = 1 << 28;
  EXPECT_EQ(grid[0], (GridTriangle{0, 0, n, 0, n, n / 2}));
  EXPECT_EQ(grid[1], (GridTriangle{0, 0, n, n / 2, 0, n / 2}));
}

TEST(OnGrid, AllPointsAlike) {
  const Points2 uv = Points2::Constant(3, 2, 0.7);
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  EXPECT_EQ(OnGrid(uv, triangles)[0], (GridTriangle{0, 0, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace dcharts
