// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/lloyd.h"

#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"
#include "thread_count.h"

namespace dcharts {
namespace {

using test::TestSurface;

Segmentation Segmented(const TestSurface& surface, const Params& params) {
  Progress progress;
  return Lloyd<SurfaceMesh>(*surface, params, progress).Run();
}

Params Count(int chart_count) {
  Params params;
  params.chart_count = chart_count;
  return params;
}

// Which sides share a chart is open: two sides are a cylinder, and three around a corner a cone.
TEST(Lloyd, SixChartsOnACubeFitExactly) {
  const TestSurface surface(shapes::Cube(8));
  const Segmentation result = Segmented(surface, Count(6));
  EXPECT_EQ(ChartCount(result.ids), 6);
  EXPECT_NEAR(result.energy, 0, 1e-12);
  EXPECT_NEAR(result.unassigned_area, 0, 1e-12);
  for (const auto& faces : FacesOfCharts(result.ids)) {
    NormalMoments moments;
    for (int f : faces) moments.Add(surface->Area(f), surface->Normal(f));
    double error = 1;
    FitCone(moments, &error);
    EXPECT_NEAR(error, 0, 1e-12);
  }
}

TEST(Lloyd, ChartCountIsTheNumberOfSeeds) {
  const TestSurface surface(shapes::Sphere(8));
  for (int count : {1, 2, 5, 12, 30}) {
    const Segmentation result = Segmented(surface, Count(count));
    EXPECT_EQ(ChartCount(result.ids), count);
    EXPECT_TRUE(test::ChartsAreWhole(*surface, result.ids));
  }
}

TEST(Lloyd, DevelopableShapesNeedNoEnergy) {
  for (const SurfaceData& mesh : {shapes::OpenCylinder(24), shapes::OpenCone(24), shapes::Grid(10, 10)}) {
    const Segmentation result = Segmented(TestSurface(mesh), Count(0));
    EXPECT_NEAR(result.energy, 0, 1e-9);
    EXPECT_EQ(ChartCount(result.ids), 1);
  }
}

TEST(Lloyd, CountOfALargeSurfaceIsTheSameOnAnyNumberOfThreads) {
  const TestSurface surface(shapes::Plush(100));
  ASSERT_GT(surface->FaceCount(), 45000);
  std::vector<Segmentation> results;
  for (int threads : {1, 2, 3}) {
    const test::Threads count(threads);
    results.push_back(Segmented(surface, Count(0)));
  }
  EXPECT_GT(ChartCount(results[0].ids), 2);
  for (const Segmentation& result : results) {
    EXPECT_EQ(result.ids, results[0].ids);
    EXPECT_EQ(result.iterations, results[0].iterations) << "those that were only guesses don't count";
  }
}

TEST(Lloyd, CountIsFoundWhereSeveralAreNeeded) {
  const auto count = [](const SurfaceData& mesh) {
    return ChartCount(Segmented(TestSurface(mesh), Count(0)).ids);
  };
  EXPECT_GE(count(shapes::Cube(6)), 2);  // two or three cylinders of sides
  EXPECT_LE(count(shapes::Cube(6)), 6);
  EXPECT_GE(count(shapes::Sphere(8)), 3);
  EXPECT_GT(count(shapes::Plush(32)), count(shapes::OpenCylinder()));
}

TEST(Lloyd, EnergyIsTheMeanErrorWithHolesAtTheBound) {
  const TestSurface surface(shapes::Plush(32));
  Params params = Count(6);
  const Segmentation result = Segmented(surface, params);
  double unassigned = 0;
  for (int f = 0; f < surface->FaceCount(); ++f)
    if (result.ids[f] == kUnassigned) unassigned += surface->Area(f);
  EXPECT_GE(result.energy, params.max_fitting_error * result.unassigned_area - 1e-12);
  EXPECT_LE(result.energy, params.max_fitting_error);
  // Charts too small to keep have become holes afterwards, so there may be more of them than counted.
  EXPECT_GE(unassigned, result.unassigned_area - 1e-9);
  EXPECT_LT(unassigned, result.unassigned_area + 0.02);
}

TEST(Lloyd, MoreChartsFitBetter) {
  const TestSurface surface(shapes::Sphere(10));
  EXPECT_LT(Segmented(surface, Count(20)).energy, Segmented(surface, Count(4)).energy);
}

TEST(Lloyd, TighterBoundLeavesMoreUnassigned) {
  const TestSurface surface(shapes::Sphere(10));
  double last = 1;
  for (double bound : {0.002, 0.02, 0.2, 4.0}) {
    Params params = Count(6);
    params.max_fitting_error = bound;
    const double unassigned = Segmented(surface, params).unassigned_area;
    EXPECT_LE(unassigned, last + 0.02) << bound;
    last = unassigned;
  }
  EXPECT_EQ(last, 0) << "a bound of 4 refuses nothing";
}

TEST(Lloyd, IterationsAreBounded) {
  const TestSurface surface(shapes::Plush(32));
  for (int bound : {1, 2, 5}) {
    Params params = Count(10);
    params.max_iterations = bound;
    params.reassigned_percent = 0;
    const Segmentation result = Segmented(surface, params);
    EXPECT_LE(result.iterations, bound);
    EXPECT_GE(result.iterations, 1);
  }
}

TEST(Lloyd, ReassignedPercentStopsEarlier) {
  const TestSurface surface(shapes::Plush(32));
  int last = 0;
  for (double percent : {100.0, 20.0, 5.0, 0.0}) {
    Params params = Count(10);
    params.max_iterations = 30;
    params.reassigned_percent = percent;
    const int iterations = Segmented(surface, params).iterations;
    EXPECT_GE(iterations, last) << percent;
    last = iterations;
  }
  EXPECT_GT(last, 10) << "0: never fewer faces than none, it goes on as long as anything is gained";
  Params params = Count(10);
  params.reassigned_percent = 100;
  EXPECT_LE(Segmented(surface, params).iterations, 2);
}

TEST(Lloyd, TheBestIterationIsKept) {
  const TestSurface surface(shapes::Plush(32));
  double last = 1e300;
  for (int bound : {1, 3, 10, 30}) {
    Params params = Count(8);
    params.max_iterations = bound;
    params.reassigned_percent = 0;
    const double energy = Segmented(surface, params).energy;
    EXPECT_LE(energy, last) << bound;
    last = energy;
  }
}

TEST(Lloyd, SeedCandidatesMatter) {
  const TestSurface surface(shapes::Plush(32));
  Params one = Count(10), many = Count(10);
  one.seed_candidates = 1;
  one.seed_percent = 0;
  many.seed_candidates = 500;
  many.seed_percent = 0;
  EXPECT_NE(Segmented(surface, one).ids, Segmented(surface, many).ids);
}

TEST(Lloyd, MoreChartsThanFaces) {
  const TestSurface surface(shapes::Cube(1));
  const Segmentation result = Segmented(surface, Count(500));
  EXPECT_LE(ChartCount(result.ids), 12);
  EXPECT_GE(ChartCount(result.ids), 1);
}

TEST(Lloyd, SeveralComponents) {
  const TestSurface surface(shapes::TwoComponents(4));
  const Segmentation result = Segmented(surface, Count(1));
  EXPECT_GT(result.unassigned_area, 0.3) << "one seed: the other component has no chart";
  EXPECT_TRUE(test::ChartsAreWhole(*surface, Segmented(surface, Count(9)).ids));
}

}  // namespace
}  // namespace dcharts
