// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fill.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

ChartIds Filled(const TestSurface& surface, ChartIds ids, const Params& params = {}) {
  Progress progress;
  HoleFiller<SurfaceMesh>(*surface, params, progress).Run(ids);
  return ids;
}

void ExpectComplete(const TestSurface& surface, const ChartIds& ids) {
  EXPECT_EQ(std::count(ids.begin(), ids.end(), kUnassigned), 0);
  EXPECT_TRUE(test::ChartsAreWhole(*surface, ids));
}

// A sheet with a round hole in the middle of the one chart.
ChartIds SheetWithHole(const TestSurface& surface, double radius) {
  return surface.Paint(
      [&](const auto& p) { return std::hypot(p[0] - 0.5, p[1] - 0.5) < radius ? kUnassigned : 0; });
}

TEST(Fill, SmallHoleIsGrownOver) {
  const TestSurface surface(shapes::Grid(30, 30));
  const ChartIds ids = SheetWithHole(surface, 0.05);  // 0.8 % of the area
  ASSERT_GT(std::count(ids.begin(), ids.end(), kUnassigned), 0);
  EXPECT_EQ(Filled(surface, ids), ChartIds(surface->FaceCount(), 0));
}

TEST(Fill, LargeHoleGetsAChart) {
  const TestSurface surface(shapes::Grid(30, 30));
  const ChartIds ids = SheetWithHole(surface, 0.2), filled = Filled(surface, ids);
  ExpectComplete(surface, filled);
  for (int f = 0; f < surface->FaceCount(); ++f) EXPECT_EQ(filled[f], ids[f] == 0 ? 0 : 1) << f;
}

TEST(Fill, SmallHolePercentDecides) {
  const TestSurface surface(shapes::Grid(30, 30));
  const ChartIds ids = SheetWithHole(surface, 0.2);
  const double percent = 100 * surface.AreaOf(ids, kUnassigned) / surface->TotalArea();
  Params params;
  params.small_hole_percent = percent + 0.1;
  EXPECT_EQ(ChartCount(Filled(surface, ids, params)), 1);
  params.small_hole_percent = percent - 0.1;
  EXPECT_EQ(ChartCount(Filled(surface, ids, params)), 2);
  params.small_hole_percent = 0;
  EXPECT_EQ(ChartCount(Filled(surface, SheetWithHole(surface, 0.05), params)), 2);
}

TEST(Fill, ASmallHoleIsSharedByItsNeighbours) {
  const TestSurface surface(shapes::Grid(40, 40));
  const ChartIds ids = surface.Paint([](const auto& p) {
    if (std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.055) return kUnassigned;
    return (p[0] < 0.5 ? 0 : 1) + (p[1] < 0.5 ? 0 : 2);
  });
  const ChartIds filled = Filled(surface, ids);
  ExpectComplete(surface, filled);
  EXPECT_EQ(ChartCount(filled), 4);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(surface.AreaOf(filled, c), 0.25, 0.01) << c;
}

// The hole is half a sphere: the chart made for it holds a part only, the rest is filled again.
TEST(Fill, LargeHolesAreFilledRecursively) {
  const TestSurface surface(shapes::Sphere(10));
  const ChartIds ids = surface.Paint([](const auto& p) { return p[2] > 0.8 ? 0 : kUnassigned; });
  Params params;
  params.max_fitting_error = 0.03;
  const ChartIds filled = Filled(surface, ids, params);
  ExpectComplete(surface, filled);
  EXPECT_GE(ChartCount(filled), 4);
  for (int f = 0; f < surface->FaceCount(); ++f)
    if (ids[f] == 0) {
      EXPECT_EQ(filled[f], 0);
    }
  // A looser bound needs fewer.
  params.max_fitting_error = 4;
  EXPECT_EQ(ChartCount(Filled(surface, ids, params)), 2);
}

TEST(Fill, NothingAssignedAtAll) {
  for (const SurfaceData& mesh : {shapes::Cube(4), shapes::Sphere(5), shapes::TwoComponents(3)}) {
    const TestSurface surface(mesh);
    const ChartIds filled = Filled(surface, ChartIds(surface->FaceCount(), kUnassigned));
    ExpectComplete(surface, filled);
  }
}

TEST(Fill, NothingToFill) {
  const TestSurface surface(shapes::Cube(3));
  const ChartIds sides = surface.Paint([](const auto& p) { return test::CubeSide(p, {0.5, 0.5, 0.5}, 0.5); });
  EXPECT_EQ(Filled(surface, sides), sides);
}

TEST(Fill, SmallComponentWithoutAChart) {
  SurfaceData mesh = shapes::Grid(10, 10);
  const int v = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back({2, 0, 0});
  mesh.vertices.push_back({2.05, 0, 0});
  mesh.vertices.push_back({2, 0.05, 0});
  mesh.faces.push_back({v, v + 1, v + 2});
  const TestSurface surface(mesh);
  ChartIds ids(surface->FaceCount(), 0);
  ids.back() = kUnassigned;
  const ChartIds filled = Filled(surface, ids);
  ExpectComplete(surface, filled);
  EXPECT_EQ(filled.back(), 1);
}

TEST(Fill, FacesWithoutAreaAreFilledToo) {
  SurfaceData mesh = shapes::Grid(8, 8);
  for (auto& p : mesh.vertices)
    if (std::abs(p[0] - 0.5) < 1e-9) p[0] = 0.375;
  const TestSurface surface(mesh);
  const ChartIds ids = surface.Paint([](const auto& p) {
    return std::abs(p[0] - 0.375) < 1e-9 ? kUnassigned : p[0] < 0.375 ? 0 : 1;
  });
  ASSERT_GT(std::count(ids.begin(), ids.end(), kUnassigned), 0);
  const ChartIds filled = Filled(surface, ids);
  ExpectComplete(surface, filled);
  EXPECT_EQ(ChartCount(filled), 2);
}

TEST(Fill, NoiseDoesNotRecurseForever) {
  SurfaceData mesh = shapes::Grid(25, 25);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> noise(-0.1, 0.1);
  for (auto& p : mesh.vertices) p[2] = noise(random);
  const TestSurface surface(mesh);
  Params params;
  params.max_fitting_error = 0.01;
  params.small_hole_percent = 0;
  ExpectComplete(surface, Filled(surface, ChartIds(surface->FaceCount(), kUnassigned), params));
}

TEST(Fill, RandomPaintIsCompleted) {
  const TestSurface surface(shapes::Torus(12));
  std::mt19937 random(12);
  for (int trial = 0; trial < 10; ++trial) {
    ChartIds ids(surface->FaceCount());
    for (int& id : ids) id = static_cast<int>(random() % 5) - 1;
    ExpectComplete(surface, Filled(surface, ids));
  }
}

}  // namespace
}  // namespace dcharts
