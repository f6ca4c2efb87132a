// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/split_bad_charts.h"

#include <algorithm>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

ChartIds Split(const TestSurface& surface, ChartIds ids, double bound) {
  Progress progress;
  SplitBadCharts(*surface, bound, progress, ids);
  return ids;
}

TEST(SplitBadCharts, UntilAllLieFlatWithinTheBound) {
  for (const SurfaceData& mesh : {shapes::Sphere(6), shapes::Torus(10), shapes::Plush(32)}) {
    const TestSurface surface(mesh);
    int last = 0;
    for (double bound : {1.1, 1.01, 1.001}) {
      const ChartIds ids = Split(surface, ChartIds(surface->FaceCount(), 0), bound);
      EXPECT_TRUE(test::ChartsAreWhole(*surface, ids));
      EXPECT_EQ(std::count(ids.begin(), ids.end(), kUnassigned), 0);
      const SeamMask no_seams(surface->FaceCount(), 0);
      for (int c = 0; c < ChartCount(ids); ++c)
        EXPECT_TRUE(TryChart(surface.Patch(ids, no_seams, c), bound, [] {}).flat);
      EXPECT_GT(ChartCount(ids), last) << bound;
      last = ChartCount(ids);
    }
  }
}

TEST(SplitBadCharts, GoodChartsStay) {
  const TestSurface plane(shapes::Grid(8, 8));
  const ChartIds halves = plane.Paint([](const auto& p) { return p[0] < 0.5 ? 0 : 1; });
  EXPECT_EQ(Split(plane, halves, 1), halves);
  // Only the round one of two is split: the parts of the other keep together.
  const TestSurface both(shapes::TwoComponents(5));
  ChartIds components(both->FaceCount(), 0);
  SplitAndCompact(*both, components);
  ASSERT_EQ(ChartCount(components), 2);
  const ChartIds ids = Split(both, components, 1.01);
  std::map<int, int> part_of;
  for (int f = 0; f < both->FaceCount(); ++f)
    EXPECT_EQ(part_of.emplace(ids[f], components[f]).first->second, components[f]);
}

TEST(SplitBadCharts, EndsAtSingleFaces) {
  const TestSurface surface(shapes::Sphere(1));
  const ChartIds ids = Split(surface, ChartIds(surface->FaceCount(), 0), 1);
  EXPECT_GE(ChartCount(ids), 4);
  EXPECT_LE(ChartCount(ids), surface->FaceCount());
}

}  // namespace
}  // namespace dcharts
