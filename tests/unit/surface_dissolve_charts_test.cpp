// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/dissolve_charts.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

// Four columns of a square, of which the middle two were merged to a chart.
class DissolveCharts : public ::testing::Test {
 protected:
  DissolveCharts()
      : surface_(shapes::Grid(16, 16)),
        parts_(*surface_,
               surface_.Paint([](const auto& p) { return std::clamp(static_cast<int>(p[0] * 4), 0, 3); }),
               false),
        groups_(parts_, params_, progress_) {
    groups_.bound = params_.StretchBound();
    middle_ = groups_.Join(1, 2, groups_.Trial({1, 2}));
  }

  // The parts of each chart that is left, sorted.
  std::vector<std::vector<int>> Charts() const {
    std::vector<std::vector<int>> charts;
    for (const auto& chart : groups_.charts)
      if (chart.alive) charts.push_back(chart.parts);
    std::sort(charts.begin(), charts.end());
    return charts;
  }

  using Sets = std::vector<std::vector<int>>;

  Params params_;
  Progress progress_;
  TestSurface surface_;
  ChartParts<SurfaceMesh> parts_;
  ChartGroups<SurfaceMesh> groups_;
  int middle_ = -1;
};

TEST_F(DissolveCharts, PartsThatOverlapAreNotTriedWithOthers) {
  groups_.overlapping.push_back({0, 1});
  EXPECT_TRUE(groups_.HoldsOverlap({0, 1, 2}));
  EXPECT_FALSE(groups_.HoldsOverlap({0, 2}));
  EXPECT_FALSE(groups_.Trial({0, 1, 2}).flat);
  EXPECT_TRUE(groups_.Trial({1, 2}).flat);
  params_.target_charts = 2;
  EXPECT_FALSE(groups_.HoldsOverlap({0, 1, 2}));
}

TEST_F(DissolveCharts, GoesWholeToANeighbour) {
  ChartDissolver<SurfaceMesh> dissolver(groups_);
  ASSERT_TRUE(dissolver.FindPlaces(0));
  dissolver.Apply();
  EXPECT_EQ(Charts(), (Sets{{0, 1, 2}, {3}}));
  EXPECT_EQ(groups_.alive, 2);
}

TEST_F(DissolveCharts, GoesInPiecesWhereItCanNotGoWhole) {
  groups_.apart = {{0, 2}, {1, 3}};
  ChartDissolver<SurfaceMesh> dissolver(groups_);
  ASSERT_TRUE(dissolver.FindPlaces(middle_));
  EXPECT_EQ(Charts(), (Sets{{0}, {1, 2}, {3}})) << "nothing is changed before Apply";
  dissolver.Apply();
  EXPECT_EQ(Charts(), (Sets{{0, 1}, {2, 3}}));
  EXPECT_EQ(groups_.alive, 2);
}

TEST_F(DissolveCharts, StaysWhenAPieceHasNoPlace) {
  groups_.apart = {{0, 1}, {0, 2}, {1, 3}};
  EXPECT_FALSE(ChartDissolver<SurfaceMesh>(groups_).FindPlaces(middle_));
  EXPECT_EQ(Charts(), (Sets{{0}, {1, 2}, {3}}));
  EXPECT_EQ(groups_.alive, 3);
}

TEST_F(DissolveCharts, KeepsWithinTheBound) {
  for (const std::vector<int>& some : Sets{{0, 1, 2}, {1, 2, 3}, {0, 1}}) groups_.Forbid(some);
  EXPECT_FALSE(ChartDissolver<SurfaceMesh>(groups_).FindPlaces(middle_));
}

}  // namespace
}  // namespace dcharts
