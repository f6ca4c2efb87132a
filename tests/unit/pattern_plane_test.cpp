// SPDX-License-Identifier: GPL-3.0-or-later
/// The plane geometry under patterns: segments, regions, triangles, circles.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/errors.h"
#include "common/pi.h"
#include "pattern/folds.h"
#include "pattern/label_place.h"
#include "pattern/net_triangles.h"
#include "pattern/regions.h"
#include "pattern/segments.h"
#include "pattern/texts.h"
#include "pattern_fixture.h"

namespace dcharts {
namespace {

using test::AreaOf;
using test::Rectangle;

TEST(PatternSegments, CrossWhereTheyHaveAPointInCommon) {
  const LineSegment flat{{0, 0}, {2, 0}};
  EXPECT_TRUE(SegmentsCross(flat, {{1, -1}, {1, 1}}));
  EXPECT_TRUE(SegmentsCross(flat, {{1, 0}, {1, 1}}));  // touching is crossing
  EXPECT_TRUE(SegmentsCross(flat, {{1, 0}, {3, 0}}));  // lying on each other
  EXPECT_FALSE(SegmentsCross(flat, {{2.5, -1}, {2.5, 1}}));
  EXPECT_FALSE(SegmentsCross(flat, {{0, 1}, {2, 1}}));
}

TEST(PatternSegments, NeighboursMayMeetInTheirCommonCorner) {
  const LineSegment a{{0, 0}, {1, 0}, 0, 1};
  EXPECT_FALSE(SegmentsCross(a, {{1, 0}, {1, 1}, 1, 2}));
  EXPECT_TRUE(SegmentsCross(a, {{1, 0}, {0.5, 0}, 1, 2}));  // back along itself
  EXPECT_FALSE(SegmentsCross(a, {{1, 0}, {2, 0}, 1, 2}));
}

TEST(PatternSegments, TheCrossingOnesAreNamed) {
  const std::vector<LineSegment> segments{{{0, 0}, {2, 2}}, {{5, 5}, {6, 6}}, {{0, 2}, {2, 0}}};
  EXPECT_EQ(CrossingSegments(segments), (std::vector<int>{0, 2}));
}

TEST(PatternRegions, ASquareGrowsWithItsCorners) {
  const auto wide = Widened({Rectangle(40, 30)}, 7);
  ASSERT_EQ(wide.size(), 1u);
  ASSERT_EQ(wide[0].size(), 1u);
  EXPECT_NEAR(AreaOf(wide[0]), 54 * 44, 1e-2);
  EXPECT_EQ(wide[0][0].size(), 4u);
}

TEST(PatternRegions, AnInnerCornerStaysSharp) {
  const auto wide = Widened({{{0, 0}, {40, 0}, {40, 20}, {20, 20}, {20, 40}, {0, 40}}}, 5);
  ASSERT_EQ(wide.size(), 1u);
  EXPECT_EQ(wide[0][0].size(), 6u);
  EXPECT_NEAR(AreaOf(wide[0]), 50 * 50 - 20 * 20, 1e-2);
}

TEST(PatternRegions, ASharpCornerIsRoundedAndNothingWithinTheDistanceIsLost) {
  const Polyline needle{{0, 0}, {100, -4}, {100, 4}};
  const auto wide = Widened({needle}, 7);
  ASSERT_EQ(wide.size(), 1u);
  double left = 0;
  for (const Point2& p : wide[0][0]) left = std::min(left, p.x());
  EXPECT_GT(left, -7.2);  // with a mitre it would reach out 175 mm
  for (int k = 0; k < 64; ++k) {
    const double angle = 2 * kPi * k / 64;
    EXPECT_TRUE(IsInside(wide[0], 6.99 * Point2(std::cos(angle), std::sin(angle)))) << k;
  }
}

TEST(PatternRegions, ANarrowDartIsFilledAndAWideOneIsNot) {
  const auto with_dart = [](double half_mouth) {
    return Polyline{{0, 0}, {100, 0}, {100, 60}, {50 + half_mouth, 60}, {50, 20}, {50 - half_mouth, 60},
                    {0, 60}};
  };
  const auto narrow = Widened({with_dart(3)}, 7), wide = Widened({with_dart(20)}, 7);
  ASSERT_EQ(narrow.size(), 1u);
  EXPECT_TRUE(IsInside(narrow[0], {50, 60}));
  ASSERT_EQ(wide.size(), 1u);
  EXPECT_FALSE(IsInside(wide[0], {50, 60}));
  EXPECT_TRUE(IsInside(wide[0], {50, 22}));  // at the tip there is an allowance too
}

TEST(PatternRegions, WhatIsTooLargeForTheGridIsRefused) {
  EXPECT_EQ(Widened({Rectangle(130000, 100)}, 7).size(), 1u);
  for (const double length : {140000.0, 500000.0, 1e9, 1e300, std::nan("")})
    EXPECT_THROW(Widened({Rectangle(length, 100)}, 7), Error) << length;
}

TEST(PatternRegions, AHoleShrinks) {
  Polyline hole = Rectangle(30, 30);
  for (Point2& p : hole) p += Point2(10, 10);
  std::reverse(hole.begin(), hole.end());
  const auto wide = Widened({Rectangle(50, 50), hole}, 5);
  ASSERT_EQ(wide.size(), 1u);
  ASSERT_EQ(wide[0].size(), 2u);
  EXPECT_NEAR(-SignedArea(wide[0][1]), 20 * 20, 1e-2);
}

TEST(PatternRegions, TouchingHasNothingInCommon) {
  Polyline right = Rectangle(10, 10), over = right;
  for (Point2& p : right) p.x() += 10;
  for (Point2& p : over) p.x() += 9;
  EXPECT_EQ(CommonArea({{Rectangle(10, 10)}}, {{right}}), 0);
  EXPECT_NEAR(CommonArea({{Rectangle(10, 10)}}, {{over}}), 10, 1e-6);
}

TEST(PatternNetTriangles, CoverTheRegionWithoutFurtherPoints) {
  Polyline hole{{2, 2}, {2, 4}, {4, 4}, {4, 2}}, hole2{{6, 6}, {6, 8}, {8, 8}, {8, 6}};
  const std::vector<Polyline> loops{Rectangle(10, 10), hole, hole2};
  std::vector<Point2> points;
  for (const Polyline& loop : loops) points.insert(points.end(), loop.begin(), loop.end());
  const auto triangles = NetTriangles(loops);
  EXPECT_EQ(triangles.size(), points.size() + 2 * 2 - 2);  // points - 2 + 2 per hole
  double area = 0;
  for (const auto& t : triangles) {
    const double twice = Orient(points[t[0]], points[t[1]], points[t[2]]);
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_NEAR(area, 100 - 8, 1e-9);
}

TEST(PatternNetTriangles, CoverACombAndAStar) {
  Polyline comb{{0, 0}};
  for (int k = 0; k < 10; ++k) {
    comb.push_back({2.0 * k + 1, 0});
    comb.push_back({2.0 * k + 1, 9});
    comb.push_back({2.0 * k + 2, 9});
    comb.push_back({2.0 * k + 2, 0});
  }
  comb.push_back({21, 0});
  comb.push_back({21, 10});
  comb.push_back({0, 10});
  Polyline star;
  for (int k = 0; k < 20; ++k) {
    const double r = k % 2 == 0 ? 10 : 2, a = 2 * kPi * k / 20;
    star.push_back({r * std::cos(a), r * std::sin(a)});
  }
  for (const Polyline& loop : {comb, star}) {
    double area = 0;
    for (const auto& t : NetTriangles({loop})) area += Orient(loop[t[0]], loop[t[1]], loop[t[2]]) / 2;
    EXPECT_NEAR(area, SignedArea(loop), 1e-9);
  }
}

TEST(PatternLabelPlace, FindsTheLargestCircle) {
  const Circle circle = LargestCircle({Rectangle(40, 10)});
  EXPECT_NEAR(circle.radius, 5, 0.15);
  EXPECT_NEAR(circle.middle.y(), 5, 0.15);
  // An L whose thick end is the place.
  const Circle thick = LargestCircle({{{0, 0}, {100, 0}, {100, 10}, {30, 10}, {30, 30}, {0, 30}}});
  EXPECT_NEAR(thick.radius, 15, 0.6);
}

TEST(PatternClip, KeepsWhatLiesInTheRegion) {
  const Polyline u{{0, 0}, {30, 0}, {30, 30}, {20, 30}, {20, 10}, {10, 10}, {10, 30}, {0, 30}};
  const auto parts = ClipToRegion({-5, 20}, {35, 20}, {u});
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0].first.x(), 0, 1e-9);
  EXPECT_NEAR(parts[0].second.x(), 10, 1e-9);
  EXPECT_NEAR(parts[1].first.x(), 20, 1e-9);
  EXPECT_NEAR(parts[1].second.x(), 30, 1e-9);
}

TEST(PatternTexts, NameLengthsAndPieces) {
  EXPECT_EQ(LengthText(7), "7 mm");
  EXPECT_EQ(LengthText(12.345), "12.3 mm");
  EXPECT_EQ(LengthText(2.5e20), "2.5e+20 mm");
  EXPECT_EQ(PieceList({2}), "piece 3");
  EXPECT_EQ(PieceList({2, 4, 7}), "pieces 3, 5 and 8");
}

}  // namespace
}  // namespace dcharts
