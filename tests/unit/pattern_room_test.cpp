// SPDX-License-Identifier: GPL-3.0-or-later
/// Room for the seam allowance: pieces that bend round until they are near themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/pi.h"
#include "pattern/allowance.h"
#include "pattern/near_itself.h"
#include "pattern_fixture.h"
#include "shapes.h"

namespace dcharts {
namespace {

using namespace test;

// Part of a ring of radii 60 and 100 mm that is open by `gap` degrees.
FlatCharts OpenRing(double gap) {
  const auto bend = [gap](const Point3& p) -> Point2 {
    const double angle = p.x() * (360 - gap) * kPi / 180, radius = 60 + 40 * p.y();
    return {-radius * std::cos(angle), radius * std::sin(angle)};
  };
  return ChartsOf(
      shapes::Grid(80, 4), [](const Point3&) { return 0; }, bend);
}

// A ring with a slit of that width, mm.
Pattern SlitRing(double width) {
  Polyline outline;
  constexpr int kCorners = 60;
  const double half = std::asin(width / 2 / 40);
  for (const double radius : {60.0, 30.0})
    for (int k = 0; k <= kCorners; ++k) {
      const double t = radius > 50 ? k : kCorners - k, angle = half + t * (2 * kPi - 2 * half) / kCorners;
      outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  Pattern pattern = PatternOfOutlines({outline});
  pattern.pieces[0].label_radius = 15;
  return pattern;
}

TEST(PatternRoom, AChartNearItselfIsFound) {
  const FlatCharts ring = OpenRing(4);
  const FlatChart& chart = ring.charts[0];
  const std::vector<int> boundary = BoundaryEdgesOf(ring, 0);
  const std::vector<char> no_cuts(3 * chart.mesh.triangles.rows(), 0);
  // Between the ends there are 60 mm times 4 degrees, at the inner corner.
  const double gap = 60 * 4 * kPi / 180;
  const auto meeting = NearItself(chart, boundary, no_cuts, 1.2 * gap);
  ASSERT_TRUE(meeting.has_value());
  double left = 1, right = 1;  // the two ends of the strip
  for (int h : {meeting->first, meeting->second}) {
    const Point2 p = chart.uv.row(StartOf(chart, h)).transpose();
    (p.y() > -2 ? left : right) = p.x();
  }
  EXPECT_LT(left, 0);
  EXPECT_LT(right, 0);
  EXPECT_FALSE(NearItself(chart, boundary, no_cuts, 0.9 * gap).has_value());
  const std::vector<char> cuts(no_cuts.size(), 1);
  EXPECT_FALSE(NearItself(chart, boundary, cuts, 1.2 * gap).has_value());
}

TEST(PatternRoom, AcrossTheClothThereIsNoMatter) {
  // A strip of 4 mm: its sides are near each other, with cloth between them.
  const FlatCharts strip = ChartsOf(
      shapes::Grid(40, 2), [](const Point3&) { return 0; },
      [](const Point3& p) { return Point2(200 * p.x(), 4 * p.y()); });
  const std::vector<int> boundary = BoundaryEdgesOf(strip, 0);
  const std::vector<char> no_cuts(3 * strip.charts[0].mesh.triangles.rows(), 0);
  EXPECT_FALSE(NearItself(strip.charts[0], boundary, no_cuts, 7).has_value());
}

TEST(PatternRoom, APocketIsCutOutAndTold) {
  for (const double width : {5.0, 40.0}) {
    Pattern pattern = SlitRing(width);
    AddAllowances(7, pattern);
    const bool closed = width < 14;
    EXPECT_EQ(pattern.pieces[0].cut.size(), closed ? 2u : 1u);
    EXPECT_EQ(pattern.warnings.size(), closed ? 1u : 0u);
    if (!closed) continue;
    EXPECT_NEAR(SignedArea(pattern.pieces[0].cut[1]), -kPi * 23 * 23, 60);
  }
}

TEST(PatternRoom, WhatADartEnclosesStaysClothToFold) {
  Pattern pattern = SlitRing(5);
  for (Seam& seam : pattern.seams) seam.is_dart = true;
  AddAllowances(7, pattern);
  EXPECT_EQ(pattern.pieces[0].cut.size(), 1u);
  EXPECT_TRUE(pattern.warnings.empty());
}

}  // namespace
}  // namespace dcharts
