// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/stretch_darts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "planar/normalized_chart.h"
#include "planar/trial_flatten.h"
#include "surface/patch_paths.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

DartGoal Goal(double l2, double linf, double longest) {
  DartGoal goal;
  goal.l2_stretch = l2;
  goal.linf_stretch = linf;
  goal.longest = longest;
  return goal;
}

double Length(const ChartPatch& patch, const std::vector<int>& edges) {
  double length = 0;
  for (int h : edges) length += patch.Length(h);
  return length;
}

DartedChart OfQuickMap(DartedChart chart) {
  chart.flat = FlatWithoutFinish(chart.patch, nullptr, [] {});
  return chart;
}

TEST(StretchDarts, AConeGetsOneToItsApex) {
  const TestSurface surface(shapes::OpenCone(24));
  const ChartPatch patch = surface.WholePatch();
  const DartedChart chart = CutStretchDarts(patch, Goal(1.01, 1.3, patch.Diagonal()), [] {});
  ASSERT_TRUE(chart.flat.ok);
  EXPECT_EQ(chart.count, 1);
  EXPECT_NEAR(chart.flat.l2_stretch, 1, 1e-6);
  EXPECT_NEAR(chart.flat.linf_stretch, 1, 1e-4);
  EXPECT_FALSE(Overlaps(chart));
  EXPECT_NEAR(Length(patch, chart.edges) / surface.Scale(), std::sqrt(1.25), 0.01) << "straight up a side";
  bool apex = false;
  for (int h : chart.edges)
    for (int k : {h, Next(h)})
      apex |= surface.InputPosition(surface->Vertex(patch.SurfaceHalfEdge(k)))[2] > 1 - 1e-9;
  EXPECT_TRUE(apex);
}

// Four equal corners: the worst stretch falls only when there is a dart to each.
TEST(StretchDarts, ABoxWithoutLidGetsOneToEachCorner) {
  SurfaceData mesh = shapes::Cube(8);
  std::vector<std::array<int, 3>> faces;
  for (const auto& face : mesh.faces) {
    const bool lid =
        std::all_of(face.begin(), face.end(), [&](int v) { return mesh.vertices[v][2] > 1 - 1e-9; });
    if (!lid) faces.push_back(face);
  }
  mesh.faces = faces;
  const TestSurface surface(mesh);
  const ChartPatch patch = surface.WholePatch();
  const DartedChart chart = CutStretchDarts(patch, Goal(1.01, 1.3, patch.Diagonal()), [] {});
  EXPECT_EQ(chart.count, 4);
  EXPECT_NEAR(Length(patch, chart.edges) / surface.Scale(), 4, 1e-9) << "the upright edges";
  EXPECT_NEAR(chart.flat.l2_stretch, 1, 1e-6);
  EXPECT_FALSE(Overlaps(chart));
}

TEST(StretchDarts, ACapGetsFlatterByEach) {
  const TestSurface surface(shapes::SphericalCap(12, 1.5));
  const ChartPatch patch = surface.WholePatch();
  const Flattening before = Flatten(patch.mesh);
  const DartedChart chart = CutStretchDarts(patch, Goal(1.01, 1.3, patch.Diagonal()), [] {});
  ASSERT_TRUE(chart.flat.ok);
  EXPECT_GE(chart.count, 1);
  EXPECT_LT(chart.flat.l2_stretch, before.l2_stretch);
  EXPECT_FALSE(Overlaps(chart));
  // Darts open nothing: one boundary loop, cut in from the rim.
  EXPECT_EQ(LoopsOf(chart.patch).size(), 1u);
  EXPECT_EQ(EulerCharacteristic(chart.patch), 1);
  EXPECT_EQ(chart.flat.uv.rows(), chart.patch.VertexCount());
}

TEST(StretchDarts, ReachTheirGoalAndStop) {
  const TestSurface surface(shapes::SphericalCap(12, 1.2));
  const ChartPatch patch = surface.WholePatch();
  const double infinite = std::numeric_limits<double>::infinity();
  const double flat = Flatten(patch.mesh).l2_stretch;
  ASSERT_GT(flat, 1.001);
  EXPECT_EQ(CutStretchDarts(patch, Goal(flat + 1e-6, infinite, patch.Diagonal()), [] {}).count, 0);
  const double goal = 1 + (flat - 1) / 2;
  const DartedChart chart = CutStretchDarts(patch, Goal(goal, infinite, patch.Diagonal()), [] {});
  EXPECT_GE(chart.count, 1);
  EXPECT_LE(chart.flat.l2_stretch, goal);
}

TEST(StretchDarts, OneThatDoesNotHelpIsTakenBack) {
  SurfaceData bump = shapes::Disk(16);
  for (auto& p : bump.vertices) p[2] = 0.4 * std::exp(-(p[0] * p[0] + p[1] * p[1]) / 0.05);
  const TestSurface surface(bump);
  const ChartPatch patch = surface.WholePatch();
  const Flattening flat = Flatten(patch.mesh);
  ASSERT_GT(flat.linf_stretch, 1.1);
  // A dart's length is dear: no fall of the Linf stretch is worth it.
  DartGoal goal = Goal(flat.l2_stretch + 1e-6, 1, patch.Diagonal());
  goal.unit = 1e-9;
  const DartedChart chart = CutStretchDarts(patch, goal, [] {});
  EXPECT_EQ(chart.count, 0);
  EXPECT_TRUE(chart.edges.empty());
  EXPECT_EQ(chart.patch.opposite, patch.opposite);
  EXPECT_EQ(chart.flat.uv,
            Flatten(patch.mesh, {FlattenMethod::kStretchMinimizing, true, goal.l2_stretch}).uv);
  // Length costs nothing.
  goal.unit = 1e9;
  EXPECT_GE(CutStretchDarts(patch, goal, [] {}).count, 1);
}

TEST(StretchDarts, FlatChartsGetNone) {
  for (const SurfaceData& mesh : {shapes::Grid(8, 8), shapes::Disk(6), shapes::PlaneWithHole(12)}) {
    const ChartPatch patch = TestSurface(mesh).WholePatch();
    const DartedChart chart = CutStretchDarts(patch, Goal(1.01, 1.3, patch.Diagonal()), [] {});
    EXPECT_EQ(chart.count, 0);
    EXPECT_NEAR(chart.flat.l2_stretch, 1, 1e-6);
  }
}

TEST(StretchDarts, AreNoLongerThanAllowed) {
  const TestSurface surface(shapes::SphericalCap(12, 1.5));
  const ChartPatch patch = surface.WholePatch();
  int most = 0;
  for (double share : {0.0, 0.1, 0.25, 0.6}) {
    const double longest = share * patch.Diagonal();
    const DartedChart chart = CutStretchDarts(patch, Goal(1, 1.01, longest), [] {});
    EXPECT_LE(Length(patch, chart.edges), chart.count * longest * (1 + 1e-12)) << share;
    if (share == 0) {
      EXPECT_EQ(chart.count, 0);
    }
    most = std::max(most, chart.count);
  }
  EXPECT_GE(most, 1);
}

// Merge tries charts without a goal for the worst stretch, and Cut is to find darts that do for them again.
TEST(StretchDarts, WhatReachesTheMeanReachesItWithTheFinishToo) {
  int reached = 0;
  const auto check = [&](const TestSurface& surface,
                         const std::function<bool(const std::array<double, 3>&)>& some) {
    const ChartIds ids = surface.Paint([&](const auto& p) { return some(p) ? 0 : 1; });
    const ChartPatch patch = surface.Patch(ids, SeamMask(surface->FaceCount(), 0), 0);
    const DartedChart mean =
        CutStretchDarts(patch, Goal(1.01, std::numeric_limits<double>::infinity(), 10), [] {});
    if (!mean.flat.ok || mean.count == 0 || mean.flat.l2_stretch > 1.01) return;
    ++reached;
    EXPECT_LE(CutStretchDarts(patch, Goal(1.01, 1.3, 10), [] {}).flat.l2_stretch, 1.01);
  };
  for (double height : {-0.2, 0.0, 0.2})
    check(TestSurface(shapes::Sphere(12)), [=](const auto& p) { return p[2] > height; });
  for (double x : {-0.2, 0.0, 0.2})
    for (double y : {-0.3, 0.1}) {
      check(TestSurface(shapes::Plush(32)), [=](const auto& p) { return p[0] > x && p[1] > y; });
      check(TestSurface(shapes::Plush(32)), [=](const auto& p) { return p[2] > x; });
    }
  EXPECT_GE(reached, 3);
}

TEST(StretchDarts, AKnownFlatteningIsTaken) {
  const TestSurface surface(shapes::SphericalCap(10, 1.3));
  const ChartPatch patch = surface.WholePatch();
  const DartGoal goal = Goal(1.01, 1.2, patch.Diagonal());
  FlattenOptions options;
  options.l2_bound = goal.l2_stretch;
  const Flattening known = Flatten(patch.mesh, options);
  const DartedChart a = CutStretchDarts(patch, goal, [] {}),
                    b = CutStretchDarts(patch, goal, [] {}, {&known});
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.flat.uv, b.flat.uv);
}

TEST(StretchDarts, KnownDartsForTheMeanChangeNothing) {
  const TestSurface surface(shapes::SphericalCap(12, 1.5));
  const ChartPatch patch = surface.WholePatch();
  const DartGoal goal = Goal(1.01, 1.3, patch.Diagonal());
  DartGoal mean = goal;
  mean.linf_stretch = std::numeric_limits<double>::infinity();
  const DartedChart darted = CutStretchDarts(patch, mean, [] {});
  ASSERT_GE(darted.count, 1);
  ASSERT_LE(darted.flat.l2_stretch, goal.l2_stretch);
  const DartedChart a = CutStretchDarts(patch, goal, [] {}),
                    b = CutStretchDarts(patch, goal, [] {}, {nullptr, &darted});
  EXPECT_GE(a.count, darted.count);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.flat.uv, b.flat.uv);
}

// The quick map that Merge goes by is above the bound, the atlas's map of the same chart is not.
TEST(StretchDarts, KnownDartsThatAreNotNeededAreLeft) {
  const TestSurface surface(shapes::SphericalCap(12, 1.5));
  const ChartPatch patch = surface.WholePatch();
  FlattenOptions without_finish;
  without_finish.linf_finish = false;
  const double quick = TrialFlatten(patch.mesh).l2_stretch,
               least = Flatten(patch.mesh, without_finish).l2_stretch;
  ASSERT_GT(quick, least);
  DartGoal goal = Goal((quick + least) / 2, 10, patch.Diagonal());
  DartGoal mean = goal;
  mean.linf_stretch = std::numeric_limits<double>::infinity();
  const DartedChart darted = CutStretchDarts(patch, mean, [] {});
  ASSERT_GE(darted.count, 1);
  ASSERT_LE(darted.flat.l2_stretch, goal.l2_stretch);
  ASSERT_EQ(CutStretchDarts(patch, goal, [] {}).count, 0);
  EXPECT_EQ(CutStretchDarts(patch, goal, [] {}, {nullptr, &darted}).count, 0);
}

void ExpectFinishedAsAtOnce(const ChartPatch& patch, const DartGoal& goal, DartedChart chart) {
  ASSERT_TRUE(FinishDarts(
      goal, [] {}, chart));
  EXPECT_TRUE(chart.finished);
  const DartedChart at_once = CutStretchDarts(patch, goal, [] {});
  EXPECT_EQ(chart.edges, at_once.edges);
  EXPECT_EQ(chart.flat.uv, at_once.flat.uv);
}

TEST(StretchDarts, TheFinishMayComeLater) {
  const TestSurface surface(shapes::SphericalCap(12, 1.5));
  const ChartPatch patch = surface.WholePatch();
  const DartGoal goal = Goal(1.01, 1.3, patch.Diagonal());
  DartedChart chart = CutMeanDarts(patch, goal, [] {});
  EXPECT_FALSE(chart.finished);
  EXPECT_GE(chart.count, 1);
  EXPECT_LE(chart.flat.l2_stretch, goal.l2_stretch);
  FlattenOptions least;
  least.linf_finish = false;
  EXPECT_LT(chart.flat.l2_stretch - 1, 1.05 * (Flatten(chart.patch.mesh, least).l2_stretch - 1));
  ExpectFinishedAsAtOnce(patch, goal, chart);
}

TEST(StretchDarts, MoreDartsLowerTheMeanStretch) {
  const TestSurface surface(shapes::SphericalCap(12, 1.5));
  const ChartPatch patch = surface.WholePatch();
  const DartedChart before = CutMeanDarts(patch, Goal(1.01, 1.3, patch.Diagonal()), [] {});
  DartedChart chart = before;
  const double halfway = 1 + (before.flat.l2_stretch - 1) / 2;
  ASSERT_TRUE(AddMeanDarts(
      Goal(halfway, 1.3, patch.Diagonal()), [] {}, chart));
  EXPECT_FALSE(chart.finished);
  EXPECT_GT(chart.count, before.count);
  EXPECT_LT(chart.flat.l2_stretch, before.flat.l2_stretch);
  EXPECT_TRUE(std::equal(before.edges.begin(), before.edges.end(), chart.edges.begin()))
      << "those that were there stay";
  DartedChart kept = before;
  EXPECT_FALSE(AddMeanDarts(
      Goal(halfway, 1.3, 0), [] {}, kept))
      << "none may have any length";
  EXPECT_EQ(kept.edges, before.edges);
}

TEST(StretchDarts, WhatOverlapsItselfIsNotFinished) {
  DartedChart chart = Uncut(TestSurface(test::Ramp(1.5)).WholePatch());
  chart.finished = false;
  EXPECT_FALSE(FinishDarts(
      Goal(1.01, 1.3, chart.patch.Diagonal()), [] {}, chart));
  EXPECT_FALSE(chart.finished);
  EXPECT_EQ(chart.flat.uv.rows(), 0) << "it is as it was";
}

TEST(StretchDarts, WhatItsOwnDoNotSaveThoseOfACoarserChartMay) {
  const ChartPatch patch = TestSurface(shapes::SphericalCap(48, 1.57)).WholePatch();
  ASSERT_FALSE(IsLargeChart(patch.mesh));
  DartGoal goal = Goal(1.01, 1.3, 0.15 * patch.Diagonal());
  goal.may_give_up = false;  // not parted whatever comes: no more is tried
  const DartedChart own = CutStretchDarts(patch, goal, [] {});
  EXPECT_GT(own.flat.l2_stretch, goal.l2_stretch);
  goal.may_give_up = true;
  const DartedChart saved = CutStretchDarts(patch, goal, [] {});
  EXPECT_TRUE(saved.finished);
  EXPECT_LE(saved.flat.l2_stretch, goal.l2_stretch);
  EXPECT_FALSE(Overlaps(saved));
  for (int h : saved.edges) EXPECT_GE(patch.opposite[h], 0);
}

TEST(StretchDarts, ATrialOfManyTrianglesGoesByACoarserChartAndMakesNoMapInVain) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const ChartPatch patch = TestSurface(shapes::SphericalCap(70, 1.57)).WholePatch();
  ASSERT_FALSE(IsLargeChart(patch.mesh));
  DartGoal goal = Goal(1.01, kAny, patch.Diagonal());
  goal.is_trial = true;
  const DartedChart reached = CutStretchDarts(patch, goal, [] {});
  EXPECT_GE(reached.count, 1);
  EXPECT_TRUE(reached.finished);
  EXPECT_TRUE(reached.flat.ok);
  EXPECT_LE(reached.flat.l2_stretch, goal.l2_stretch);
  EXPECT_NE(reached.coarser, nullptr);
  EXPECT_FALSE(Overlaps(reached));
  DartGoal none = Goal(1.01, kAny, 0);
  EXPECT_TRUE(CutStretchDarts(patch, none, [] {}).flat.ok) << "a map above the goal";
  none.is_trial = true;
  const DartedChart missed = CutStretchDarts(patch, none, [] {});
  EXPECT_FALSE(missed.flat.ok);
  EXPECT_TRUE(missed.edges.empty());
}

TEST(StretchDarts, ALargeChartThatLapsOverALittleIsDrawnApart) {
  for (const double turns : {1.02, 1.5}) {
    DartedChart chart = Uncut(TestSurface(test::Ramp(turns, 600, 27)).WholePatch());
    ASSERT_TRUE(IsLargeChart(chart.patch.mesh));
    ASSERT_TRUE(Overlaps(OfQuickMap(chart)));
    chart.count = 1;  // as one with a dart, which is to be without overlaps
    chart.finished = false;
    chart.coarser = std::make_shared<CoarserCharts>(Normalized(chart.patch.mesh));
    const bool comes_apart = turns < 1.1;
    EXPECT_EQ(FinishDarts(
                  Goal(1.01, 1.3, chart.patch.Diagonal()), [] {}, chart),
              comes_apart);
    EXPECT_EQ(chart.finished, comes_apart);
    if (!comes_apart) continue;
    EXPECT_FALSE(Overlaps(chart));
    EXPECT_LE(chart.flat.l2_stretch, 1.01);
  }
}

TEST(StretchDarts, ALargeChartIsFlattenedLast) {
  const TestSurface surface(shapes::SphericalCap(90, 1.2));
  const ChartPatch patch = surface.WholePatch();
  const DartGoal goal = Goal(1.02, 1.3, patch.Diagonal()), strict = Goal(1.005, 1.3, patch.Diagonal());
  DartedChart chart = CutMeanDarts(patch, goal, [] {});
  EXPECT_FALSE(chart.finished);
  EXPECT_EQ(chart.flat.uv.rows(), 0);
  EXPECT_LE(chart.flat.l2_stretch, goal.l2_stretch) << "of the coarser chart";
  DartedChart more = chart;
  ASSERT_TRUE(AddMeanDarts(
      strict, [] {}, more));
  EXPECT_FALSE(more.finished);
  EXPECT_GT(more.count, chart.count);
  ExpectFinishedAsAtOnce(patch, goal, chart);
  ASSERT_TRUE(FinishDarts(
      strict, [] {}, more));
  EXPECT_LE(more.flat.l2_stretch, strict.l2_stretch);
}

TEST(StretchDarts, CoarserChartsOfALargeOneServeAgain) {
  const TestSurface surface(shapes::SphericalCap(90, 1.2));
  const ChartPatch patch = surface.WholePatch();
  ASSERT_TRUE(IsLargeChart(patch.mesh));
  const DartGoal usual = Goal(1.02, 1.3, patch.Diagonal()), strict = Goal(1.005, 1.2, patch.Diagonal());
  const DartedChart first = CutStretchDarts(patch, usual, [] {});
  ASSERT_EQ(first.count, 0) << "so the coarser charts are those of the patch";
  ASSERT_NE(first.coarser, nullptr);
  const DartedChart a = CutStretchDarts(patch, strict, [] {}),
                    b = CutStretchDarts(patch, strict, [] {}, {nullptr, nullptr, first.coarser});
  EXPECT_GE(a.count, 1);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.flat.uv, b.flat.uv);
}

}  // namespace
}  // namespace dcharts
