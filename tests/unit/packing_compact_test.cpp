// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/packing_compact.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace dcharts {
namespace {

Points2 Polygon(const std::vector<Eigen::Vector2d>& corners) {
  Points2 outline(static_cast<Eigen::Index>(2 * corners.size()), 2);
  for (size_t k = 0; k < corners.size(); ++k) {
    outline.row(static_cast<Eigen::Index>(2 * k)) = corners[k];
    outline.row(static_cast<Eigen::Index>(2 * k + 1)) = corners[(k + 1) % corners.size()];
  }
  return outline;
}

Points2 Box(double width, double height) {
  return Polygon({{0, 0}, {width, 0}, {width, height}, {0, height}});
}

// Nine squares in three rows with wide gaps, each turned a little.
Packing ThreeByThree(double turn) {
  Packing packing;
  packing.scale = 0.2;
  for (int k = 0; k < 9; ++k) {
    const Eigen::Vector2d middle(0.2 + 0.3 * (k % 3), 0.2 + 0.3 * (k / 3));
    const double angle = k % 2 ? turn : -turn;
    packing.placements.push_back(
        {angle, middle - packing.scale * (Eigen::Rotation2Dd(angle) * Eigen::Vector2d(0.5, 0.5))});
  }
  return packing;
}

// Corners of a placed box, and the least distance of two: the larger of those along x and y.
std::vector<Eigen::Vector2d> Placed(const Points2& outline, const Packing& packing, size_t k) {
  std::vector<Eigen::Vector2d> corners;
  const Placement& at = packing.placements[k];
  for (Eigen::Index e = 0; e < outline.rows(); e += 2)
    corners.push_back(packing.scale * (Eigen::Rotation2Dd(at.angle) * Eigen::Vector2d(outline.row(e))) +
                      at.offset);
  return corners;
}

double Distance(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  constexpr int kSamples = 200;
  double least = 9;
  for (size_t i = 0; i < a.size(); ++i)
    for (int s = 0; s < kSamples; ++s) {
      const Eigen::Vector2d p = a[i] + static_cast<double>(s) / kSamples * (a[(i + 1) % a.size()] - a[i]);
      for (size_t j = 0; j < b.size(); ++j)
        for (int t = 0; t < kSamples; ++t) {
          const Eigen::Vector2d q = b[j] + static_cast<double>(t) / kSamples * (b[(j + 1) % b.size()] - b[j]);
          least = std::min(least, (p - q).cwiseAbs().maxCoeff());
        }
    }
  return least;
}

TEST(PackingCompact, TurnedSquaresFillTheSquare) {
  const std::vector<Points2> outlines(9, Box(1, 1));
  Packing packing = ThreeByThree(0.1);
  CompactOptions options;
  options.padding = 0.005;
  ASSERT_TRUE(Compact(outlines, options, packing.scale, {}, &packing));
  EXPECT_GT(9 * packing.scale * packing.scale, 0.93);
  for (size_t i = 0; i < 9; ++i) {
    const auto a = Placed(outlines[i], packing, i);
    for (const Eigen::Vector2d& p : a) {
      EXPECT_GE(p.minCoeff(), options.padding / 2 - 1e-12);
      EXPECT_LE(p.maxCoeff(), 1 - options.padding / 2 + 1e-12);
    }
    for (size_t j = i + 1; j < 9; ++j)
      EXPECT_GE(Distance(a, Placed(outlines[j], packing, j)), options.padding);
  }
}

TEST(PackingCompact, WithoutRotationAnglesStay) {
  const std::vector<Points2> outlines(9, Box(1, 1));
  Packing packing = ThreeByThree(0.1);
  const Packing before = packing;
  CompactOptions options;
  options.rotate = false;
  ASSERT_TRUE(Compact(outlines, options, packing.scale, {}, &packing));
  EXPECT_GT(packing.scale, before.scale);
  for (size_t k = 0; k < 9; ++k) EXPECT_EQ(packing.placements[k].angle, before.placements[k].angle);
}

TEST(PackingCompact, OverlapsAreUndone) {
  const std::vector<Points2> outlines(2, Box(1, 2));
  Packing packing;
  packing.scale = 0.4;
  packing.placements = {{0, {0.1, 0.1}}, {0, {0.495, 0.15}}};  // they overlap by 0.005
  ASSERT_TRUE(Compact(outlines, {}, 0, {}, &packing));
  EXPECT_GT(packing.scale, 0.42);
  EXPECT_GT(Distance(Placed(outlines[0], packing, 0), Placed(outlines[1], packing, 1)), 0);
}

TEST(PackingCompact, AChartInTheNotchOfAnother) {
  // A narrow U and a bar that goes into it; the bar's way out is long.
  const std::vector<Points2> outlines{
      Polygon({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}), Box(0.8, 1.8)};
  Packing packing;
  packing.scale = 0.3;
  packing.placements = {{0, {0.05, 0.05}}, {0, {0.05 + 0.3 * 1.1, 0.05 + 0.3 * 1.1}}};
  CompactOptions options;
  options.padding = 0.01;
  ASSERT_TRUE(Compact(outlines, options, packing.scale, {}, &packing));
  EXPECT_GT(packing.scale, 0.32);
  const auto u = Placed(outlines[0], packing, 0), bar = Placed(outlines[1], packing, 1);
  EXPECT_GE(Distance(u, bar), options.padding);
}

TEST(PackingCompact, RefusesWhatItCannotBetter) {
  const std::vector<Points2> outlines(2, Box(1, 2));
  Packing packing;
  packing.scale = 0.4;
  packing.placements = {{0, {0.1, 0.1}}, {0, {0.55, 0.1}}};
  const Packing before = packing;
  EXPECT_FALSE(Compact(outlines, {}, 0.6, {}, &packing));  // there is no such scale
  EXPECT_EQ(packing.scale, before.scale);
  EXPECT_EQ(packing.placements[1].offset, before.placements[1].offset);
  Points2 open(2, 2);
  open << 0, 0, 1, 1;
  EXPECT_FALSE(Compact({open, open}, {}, 0, {}, &packing));
  EXPECT_EQ(packing.scale, before.scale);
}

TEST(PackingCompact, EndsAfterItsSteps) {
  const std::vector<Points2> outlines(9, Box(1, 1));
  for (int steps : {1, 2, 20}) {
    Packing packing = ThreeByThree(0.1);
    CompactOptions options;
    options.most_steps = steps;
    int polls = 0;
    Compact(
        outlines, options, 0, [&] { ++polls; }, &packing);
    EXPECT_LE(polls, 2 * steps + 10);
  }
  Packing packing = ThreeByThree(0.1);
  EXPECT_THROW(Compact(
                   outlines, {}, 0, [] { throw 1; }, &packing),
               int);
}

}  // namespace
}  // namespace dcharts
