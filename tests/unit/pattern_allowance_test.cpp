// SPDX-License-Identifier: GPL-3.0-or-later
/// Allowances at corners and darts.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "pattern/allowance.h"
#include "pattern/regions.h"
#include "pattern_fixture.h"

namespace dcharts {
namespace {

using test::PatternOfOutlines;

// How far the cut line is at most, and at least, from the net outline's corners and edges.
struct Reach {
  double nearest = 1e9, farthest = 0;
};

Reach ReachOf(const Polyline& outline, double allowance) {
  Pattern pattern = PatternOfOutlines({outline});
  pattern.pieces[0].label_radius = 50;
  AddAllowances(allowance, pattern);
  Reach reach;
  const size_t n = outline.size();
  for (const Polyline& cut : pattern.pieces[0].cut) {
    for (const Point2& p : cut) {
      double distance = 1e9;
      for (size_t k = 0; k < n; ++k)
        distance = std::min(distance, DistanceToSegment(p, outline[k], outline[(k + 1) % n]));
      reach.farthest = std::max(reach.farthest, distance);
    }
    for (const Point2& p : outline)
      for (size_t k = 0; k < cut.size(); ++k)
        reach.nearest = std::min(reach.nearest, DistanceToSegment(p, cut[k], cut[(k + 1) % cut.size()]));
  }
  return reach;
}

constexpr double kAllowance = 7;
// A corner of 60 degrees keeps its full mitre; what is sharper is rounded.
constexpr double kFarthest = 2 * kAllowance + 0.01;

class AllowanceAtADart : public ::testing::TestWithParam<double> {};

// A square with a dart from the middle of its upper side, of this width at the mouth, mm.
TEST_P(AllowanceAtADart, IsTheAllowanceAndNoNeedle) {
  const double half = GetParam() / 2;
  for (const double depth : {2.0, 5.0, 14.0, 40.0}) {
    const Reach reach = ReachOf(
        {{0, 0}, {60, 0}, {60, 60}, {30 + half, 60}, {30, 60 - depth}, {30 - half, 60}, {0, 60}}, kAllowance);
    EXPECT_GT(reach.nearest, kAllowance - 0.01) << depth;
    EXPECT_LT(reach.farthest, kFarthest) << depth;
  }
}

INSTANTIATE_TEST_SUITE_P(Mouths, AllowanceAtADart, ::testing::Values(1e-9, 0.01, 0.5, 2.0, 8.0, 30.0),
                         [](const auto& test) { return "mouth" + std::to_string(test.index); });

TEST(Allowance, IsRoundAtANeedleOfTheNet) {
  const Reach reach =
      ReachOf({{0, 0}, {60, 0}, {60, 30}, {30.5, 30}, {30, 60}, {29.5, 30}, {0, 30}}, kAllowance);
  EXPECT_GT(reach.nearest, kAllowance - 0.01);
  EXPECT_LT(reach.farthest, kFarthest);
}

}  // namespace
}  // namespace dcharts
