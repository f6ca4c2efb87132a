// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/overlap.h"
#include "surface/rounding.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace dcharts {
namespace {

std::int64_t Area(const std::vector<int>& t, int f, const std::vector<std::int32_t>& x,
                  const std::vector<std::int32_t>& y) {
  const int a = t[3 * f], b = t[3 * f + 1], c = t[3 * f + 2];
  return TwiceArea({x[a], y[a], x[b], y[b], x[c], y[c]});
}

TEST(Rounding, GridIsExactInFloat) {
  for (std::int32_t k : {0, 1, 12345677, (1 << 24) - 1, 1 << 24}) {
    const auto t = static_cast<float>(k / kTexcoordGrid);
    EXPECT_EQ(static_cast<double>(t) * kTexcoordGrid, k);
  }
}

TEST(Rounding, GoodTrianglesStayAsTheyAre) {
  std::vector<std::int32_t> x{0, 5, 5, 0}, y{0, 0, 1, 1};
  const auto x0 = x, y0 = y;
  EXPECT_TRUE(MendRoundedTriangles({0, 1, 2, 0, 2, 3}, x, y).empty());
  EXPECT_EQ(x, x0);
  EXPECT_EQ(y, y0);
}

TEST(Rounding, NothingToDo) {
  std::vector<std::int32_t> x, y;
  EXPECT_TRUE(MendRoundedTriangles({}, x, y).empty());
}

// A fan around a vertex that rounding put on or over an edge.
TEST(Rounding, MovesAVertexOffAnEdge) {
  for (std::int32_t height : {0, -1, -2}) {
    std::vector<std::int32_t> x{1000, 1100, 1050, 1050}, y{1000, 1000, 1100, 1000 + height};
    const std::vector<int> triangles{0, 1, 3, 1, 2, 3, 2, 0, 3};
    EXPECT_TRUE(MendRoundedTriangles(triangles, x, y).empty()) << height;
    for (int f = 0; f < 3; ++f) EXPECT_GT(Area(triangles, f, x, y), 0) << height;
    for (int v = 0; v < 4; ++v) {
      EXPECT_LE(std::abs(x[v] - std::vector<int>({1000, 1100, 1050, 1050})[v]), 12);
      EXPECT_LE(std::abs(y[v] - std::vector<int>({1000, 1000, 1100, 1000 + height})[v]), 12);
    }
  }
}

TEST(Rounding, SaysWhatCannotBeMended) {
  // Two triangles over one edge that are to lie on the same side of each other: one always flips.
  std::vector<std::int32_t> x{100, 200, 150}, y{100, 100, 200};
  EXPECT_EQ(MendRoundedTriangles({0, 1, 2, 1, 0, 2}, x, y).size(), 1u);
}

// Thin triangles in a random sheet, rounded hard: whatever is not reported is positive, and nothing that was
// good goes bad.
TEST(Rounding, NoTriangleLosesItsArea) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 12;
    std::vector<std::int32_t> x, y;
    std::vector<int> triangles;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        x.push_back(static_cast<std::int32_t>(std::lround(1000 + 3 * (i + jitter(random)))));
        y.push_back(static_cast<std::int32_t>(std::lround(1000 + 1.2 * (j + jitter(random)))));
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
        triangles.insert(triangles.end(), {a, b, c, a, c, d});
      }
    std::vector<char> good;
    for (int f = 0; f < 2 * n * n; ++f) good.push_back(Area(triangles, f, x, y) > 0);
    std::vector<char> reported(good.size(), 0);
    const std::vector<int> bad = MendRoundedTriangles(triangles, x, y);
    for (int f : bad) reported[f] = 1;
    int mended = 0;
    for (int f = 0; f < 2 * n * n; ++f) {
      EXPECT_EQ(Area(triangles, f, x, y) <= 0, reported[f] == 1) << "trial " << trial << " face " << f;
      mended += !good[f] && !reported[f];
    }
    EXPECT_GT(mended, 0) << "trial " << trial;
    EXPECT_LT(bad.size(), 6u) << "trial " << trial;
  }
}

}  // namespace
}  // namespace dcharts
