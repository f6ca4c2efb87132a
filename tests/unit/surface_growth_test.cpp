// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

ChartIds None(const TestSurface& surface) { return ChartIds(surface->FaceCount(), kUnassigned); }

int FaceNearest(const TestSurface& surface, const std::array<double, 3>& point) {
  int best = 0;
  double least = 1e300;
  const ChartIds faces = surface.Paint([&, f = 0](const auto& p) mutable {
    const double d = std::hypot(p[0] - point[0], p[1] - point[1], p[2] - point[2]);
    if (d < least) {
      least = d;
      best = f;
    }
    return f++;
  });
  return best;
}

TEST(Growth, OneChartTakesAllItReaches) {
  const TestSurface surface(shapes::Torus(8));
  ChartIds ids = None(surface);
  Growth<SurfaceMesh>(*surface, Params()).FromSeeds({{5, {}}}, Growth<SurfaceMesh>::kNoBound, ids);
  EXPECT_EQ(std::count(ids.begin(), ids.end(), 0), surface->FaceCount());
}

TEST(Growth, StaysInItsComponentAndOnItsSideOfNonManifoldEdges) {
  const TestSurface surface(shapes::NonManifoldFin(4));
  ChartIds ids = None(surface);
  Growth<SurfaceMesh>(*surface, Params()).FromSeeds({{0, {}}}, Growth<SurfaceMesh>::kNoBound, ids);
  EXPECT_EQ(std::count(ids.begin(), ids.end(), 0), surface->FaceCount() / 3);
}

TEST(Growth, BoundHoldsForEveryFaceButTheSeed) {
  for (const SurfaceData& mesh : {shapes::Sphere(6), shapes::Torus(12), shapes::Cube(4), shapes::Plush(32)}) {
    const TestSurface surface(mesh);
    Seeds<SurfaceMesh> seeds(*surface);
    for (double bound : {1e-3, 0.05, 0.2, 1.0}) {
      const auto charts = seeds.FarthestPoints(7);
      ChartIds ids = None(surface);
      Growth<SurfaceMesh>(*surface, Params()).FromSeeds(charts, bound, ids);
      for (int f = 0; f < surface->FaceCount(); ++f) {
        if (ids[f] == kUnassigned || charts[ids[f]].seed == f) continue;
        ASSERT_LT(FittingError(charts[ids[f]].proxy, surface->Normal(f)), bound) << f;
      }
      EXPECT_TRUE(test::ChartsAreWhole(*surface, ids));
      // Nothing that could have been taken is left: beside a chart every unassigned face is above its bound.
      for (int h = 0; h < surface->HalfEdgeCount(); ++h) {
        const int g = surface->Neighbour(h);
        if (g < 0 || ids[h / 3] == kUnassigned || ids[g] != kUnassigned) continue;
        ASSERT_GE(FittingError(charts[ids[h / 3]].proxy, surface->Normal(g)), bound);
      }
    }
  }
}

TEST(Growth, SeedsOnTheSidesOfACubeGetTheirSides) {
  const TestSurface surface(shapes::Cube(7));
  std::vector<GrowingChart> charts;
  for (int d = 0; d < 3; ++d)
    for (int s : {0, 1}) {
      std::array<double, 3> middle{0.5, 0.5, 0.5};
      middle[d] = s;
      GrowingChart chart;
      chart.seed = FaceNearest(surface, middle);
      chart.proxy = {surface->Normal(chart.seed), 1};
      charts.push_back(chart);
    }
  ChartIds ids = None(surface);
  Growth<SurfaceMesh>(*surface, Params()).FromSeeds(charts, 0.2, ids);
  EXPECT_EQ(ids, surface.Paint([](const auto& p) { return test::CubeSide(p, {0.5, 0.5, 0.5}, 0.5); }));
}

TEST(Growth, FacesWithAChartKeepIt) {
  const TestSurface surface(shapes::Grid(6, 6));
  ChartIds ids = surface.Paint([](const auto& p) { return p[0] < 0.4 ? 0 : kUnassigned; });
  const ChartIds before = ids;
  const int seed = FaceNearest(surface, {0.8, 0.5, 0});
  Growth<SurfaceMesh>(*surface, Params()).FromSeeds({{seed, {}}}, 3, Growth<SurfaceMesh>::kNoBound, ids);
  for (int f = 0; f < surface->FaceCount(); ++f) EXPECT_EQ(ids[f], before[f] == 0 ? 0 : 3) << f;
}

TEST(Growth, TwoChartsWithOneSeed) {
  const TestSurface surface(shapes::Grid(3, 3));
  ChartIds ids = None(surface);
  Growth<SurfaceMesh>(*surface, Params()).FromSeeds({{4, {}}, {4, {}}}, 1, ids);
  EXPECT_EQ(std::count(ids.begin(), ids.end(), 0), surface->FaceCount());
}

TEST(Growth, CompactnessHalvesASheet) {
  // Two seeds on a plane, F = 0 everywhere: compactness draws the border half-way.
  const TestSurface surface(shapes::Grid(20, 20));
  std::vector<GrowingChart> charts{{FaceNearest(surface, {0.2, 0.5, 0}), {Eigen::Vector3d::UnitZ(), 1}},
                                   {FaceNearest(surface, {0.8, 0.5, 0}), {Eigen::Vector3d::UnitZ(), 1}}};
  ChartIds ids = None(surface);
  Growth<SurfaceMesh>(*surface, Params()).FromSeeds(charts, 0.2, ids);
  EXPECT_NEAR(surface.AreaOf(ids, 0), 0.5, 0.08);
  const double border = SeamLength(*surface, ChartBorders(*surface, ids));
  EXPECT_LT(border, 1.8);
  // Without compactness and straightness all costs are the same, and one chart takes nearly all.
  Params careless;
  careless.compactness_weight = careless.straightness_weight = 0;
  ids = None(surface);
  Growth<SurfaceMesh>(*surface, careless).FromSeeds(charts, 0.2, ids);
  EXPECT_GT(std::abs(surface.AreaOf(ids, 0) - 0.5), 0.3);
}

TEST(Growth, IntoHolesFillsAllAroundAndKeepsTheRest) {
  const TestSurface surface(shapes::Grid(10, 10));
  ChartIds ids = surface.Paint([](const auto& p) {
    if (std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.25) return kUnassigned;
    return p[0] < 0.5 ? 0 : 1;
  });
  const ChartIds before = ids;
  ASSERT_GT(std::count(ids.begin(), ids.end(), kUnassigned), 10);
  const std::vector<GrowingChart> charts{{0, {}}, {1, {}}};
  Growth<SurfaceMesh>(*surface, Params())
      .IntoHoles(charts, Growth<SurfaceMesh>::kNoBound, std::vector<double>(surface->FaceCount(), 0), ids);
  for (int f = 0; f < surface->FaceCount(); ++f) {
    EXPECT_NE(ids[f], kUnassigned);
    if (before[f] >= 0) {
      EXPECT_EQ(ids[f], before[f]);
    }
  }
  EXPECT_TRUE(test::ChartsAreWhole(*surface, ids));
  EXPECT_NEAR(surface.AreaOf(ids, 0), 0.5, 0.15);
}

}  // namespace
}  // namespace dcharts
