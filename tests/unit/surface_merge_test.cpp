// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/merge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "planar/flatten.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

ChartIds Merged(const TestSurface& surface, ChartIds ids, double threshold = Params().merge_threshold,
                int target = 0) {
  Params params;
  params.merge_threshold = threshold;
  params.target_charts = target;
  Progress progress;
  Merger<SurfaceMesh>(*surface, params, progress).Run(ids);
  return ids;
}

ChartIds Octants(const TestSurface& surface) {
  return surface.Paint(
      [](const auto& p) { return (p[0] > 0 ? 1 : 0) + (p[1] > 0 ? 2 : 0) + (p[2] > 0 ? 4 : 0); });
}

TEST(Merge, HalvesOfAPlaneMerge) {
  const TestSurface surface(shapes::Grid(10, 10));
  const ChartIds ids = surface.Paint([](const auto& p) { return p[0] < 0.5 ? 0 : 1; });
  EXPECT_EQ(Merged(surface, ids), ChartIds(surface->FaceCount(), 0));
  EXPECT_EQ(Merged(surface, ids, 1e-5), ChartIds(surface->FaceCount(), 0)) << "exactly developable";
}

TEST(Merge, AllPiecesOfAPlaneMerge) {
  const TestSurface surface(shapes::Grid(12, 12));
  const ChartIds ids = surface.Paint(
      [](const auto& p) { return static_cast<int>(p[0] * 4) + 4 * static_cast<int>(p[1] * 4); });
  ASSERT_EQ(ChartCount(ids), 16);
  EXPECT_EQ(ChartCount(Merged(surface, ids, 1e-5)), 1);
}

TEST(Merge, StripesOfACylinderMerge) {
  const TestSurface surface(shapes::OpenCylinder(24));
  const ChartIds ids =
      surface.Paint([](const auto& p) { return static_cast<int>((std::atan2(p[1], p[0]) + 3.15) / 1.06); });
  ASSERT_EQ(ChartCount(ids), 6);
  EXPECT_EQ(ChartCount(Merged(surface, ids, 1e-5)), 1);
}

TEST(Merge, TwoSidesOfACubeEdgeMerge) {
  // Two squares that meet at a right angle: a straight crease is developable.
  SurfaceData mesh = shapes::Grid(12, 6);
  for (auto& p : mesh.vertices)
    if (p[0] > 0.5) p = {0.5, p[1], p[0] - 0.5};
  const TestSurface surface(mesh);
  const ChartIds ids = surface.Paint([](const auto& p) { return p[2] > 1e-9 ? 1 : 0; });
  EXPECT_EQ(Merged(surface, ids, 1e-5), ChartIds(surface->FaceCount(), 0));
}

TEST(Merge, CubeSidesNeverAllMerge) {
  const TestSurface surface(shapes::Cube(6));
  const ChartIds sides = surface.Paint([](const auto& p) { return test::CubeSide(p, {0.5, 0.5, 0.5}, 0.5); });
  const int count = ChartCount(Merged(surface, sides, 1e-5));
  EXPECT_GE(count, 2);  // straight creases merge, corners don't
  EXPECT_LT(count, 6);
}

TEST(Merge, OctantsOfASphereDoNotMerge) {
  const TestSurface surface(shapes::Sphere(12));
  const ChartIds ids = Octants(surface);
  EXPECT_EQ(ChartCount(Merged(surface, ids)), 8);
}

TEST(Merge, ANumberOfChartsGoesBeforeTheThreshold) {
  const TestSurface surface(shapes::Sphere(12));
  for (int target : {1, 3, 8, 9})
    for (double threshold : {0.0, 4.0})
      EXPECT_EQ(ChartCount(Merged(surface, Octants(surface), threshold, target)), std::min(target, 8))
          << target << ", threshold " << threshold;
}

TEST(Merge, ThresholdZeroMergesNothing) {
  const TestSurface surface(shapes::Grid(10, 10));
  const ChartIds ids = surface.Paint([](const auto& p) { return p[0] < 0.5 ? 0 : 1; });
  EXPECT_EQ(Merged(surface, ids, 0), ids);
}

TEST(Merge, ASmallThresholdHalvesChartsThatAreNotDevelopable) {
  const TestSurface surface(shapes::SphericalCap(12, 1));
  const ChartIds whole(surface->FaceCount(), 0);
  const auto worst = [&](const ChartIds& ids) {
    double stretch = 1;
    for (int c = 0; c < ChartCount(ids); ++c)
      stretch = std::max(stretch,
                         Flatten(surface.Patch(ids, SeamMask(surface->FaceCount(), 0), c).mesh).l2_stretch);
    return stretch;
  };
  ASSERT_GT(worst(whole), 1.002);
  const ChartIds strict = Merged(surface, whole, 1e-5);
  EXPECT_GT(ChartCount(strict), 1);
  EXPECT_LT(worst(strict), 1.00075);
  EXPECT_EQ(Merged(surface, whole), whole) << "the usual threshold";
  EXPECT_EQ(Merged(surface, whole, 0), whole);
  EXPECT_EQ(Merged(surface, whole, 1e-5, 1), whole) << "a number of charts goes before it";
  Params params;
  params.merge_threshold = 1e-5;
  params.max_stretch = 0;  // as in the paper
  ChartIds ids = whole;
  Progress progress;
  Merger<SurfaceMesh>(*surface, params, progress).Run(ids);
  EXPECT_EQ(ids, whole);
}

TEST(Merge, LargestThresholdMergesEachComponentToOne) {
  for (const SurfaceData& mesh : {shapes::Sphere(6), shapes::TwoComponents(4), shapes::BowTie(4)}) {
    const TestSurface surface(mesh);
    ChartIds components(surface->FaceCount(), 0);
    SplitAndCompact(*surface, components);
    ChartIds ids = Octants(surface);
    SplitAndCompact(*surface, ids);
    EXPECT_EQ(Merged(surface, ids, 4), components);
  }
}

TEST(Merge, LargerThresholdsMergeMore) {
  const TestSurface surface(shapes::Sphere(10));
  int last = 8;
  for (double threshold : {1e-3, 1e-2, 1e-1, 1.0}) {
    const int count = ChartCount(Merged(surface, Octants(surface), threshold));
    EXPECT_LE(count, last);
    last = count;
  }
  EXPECT_EQ(last, 1);
}

TEST(Merge, ChartsOfDifferentComponentsNeverMerge) {
  const TestSurface surface(shapes::BowTie(4));
  ChartIds ids(surface->FaceCount(), 0);
  SplitAndCompact(*surface, ids);
  ASSERT_EQ(ChartCount(ids), 2) << "a shared vertex joins nothing";
  EXPECT_EQ(Merged(surface, ids, 4), ids);
}

TEST(Merge, APartThatCurvesBothWaysStaysApart) {
  // Three stripes: a plane in two halves, and a part that bends away in a curve of small radius, double
  // curved.
  SurfaceData mesh = shapes::Grid(30, 12);
  for (auto& p : mesh.vertices)
    if (p[0] > 2.0 / 3) {
      const double t = 4 * (p[0] - 2.0 / 3);
      p[2] = -0.4 * t * t * (1 + 3 * (p[1] - 0.5) * (p[1] - 0.5));
    }
  const TestSurface surface(mesh);
  const ChartIds ids = surface.Paint([](const auto& p) {
    return p[0] < 1.0 / 3 ? 0 : p[0] < 2.0 / 3 ? 1 : 2;
  });
  const ChartIds merged = Merged(surface, ids, 1e-6);
  for (int f = 0; f < surface->FaceCount(); ++f) EXPECT_EQ(merged[f], ids[f] == 2 ? 1 : 0);
}

}  // namespace
}  // namespace dcharts
