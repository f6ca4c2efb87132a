// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/chart_trial.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "surface/known_trials.h"
#include "surface/patch_paths.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

constexpr double kNoBound = std::numeric_limits<double>::infinity();

ChartTrial Trial(const TestSurface& surface, double bound = kNoBound) {
  return TryChart(surface.WholePatch(), bound, [] {});
}

TEST(ChartTrial, FlatShapesCostNothing) {
  for (const SurfaceData& mesh : {shapes::Grid(8, 6), shapes::Disk(6), shapes::PlaneWithHole(12)}) {
    const ChartTrial trial = Trial(TestSurface(mesh), 1.0001);
    EXPECT_TRUE(trial.flat);
    EXPECT_NEAR(trial.stretch, 1, 1e-6);
    EXPECT_NEAR(trial.energy, 0, 1e-6);
    EXPECT_EQ(trial.cut_length, 0);
  }
}

TEST(ChartTrial, ACylinderCostsItsCut) {
  const TestSurface surface(shapes::OpenCylinder(24));
  const ChartTrial trial = Trial(surface, 1.0001);
  EXPECT_TRUE(trial.flat);
  EXPECT_NEAR(trial.stretch, 1, 1e-6);
  EXPECT_NEAR(trial.cut_length / surface.Scale(), 1, 1e-9);
}

TEST(ChartTrial, ClosedSurfacesAreOpened) {
  for (const SurfaceData& mesh : {shapes::Torus(10), shapes::Sphere(5), shapes::DoubleTorus(32)}) {
    const TestSurface surface(mesh);
    double cut_length = 0;
    const ChartPatch open = Opened(surface.WholePatch(), cut_length);
    EXPECT_GE(LoopsOf(open).size(), 1u);
    EXPECT_EQ(2 - static_cast<int>(LoopsOf(open).size()), EulerCharacteristic(open)) << "no handle";
    EXPECT_GT(cut_length, 0);
    EXPECT_EQ(Trial(surface).cut_length, cut_length);
  }
}

TEST(ChartTrial, TheBoundDecides) {
  const TestSurface surface(shapes::SphericalCap(8, 1.0));
  const ChartTrial free = Trial(surface);
  ASSERT_TRUE(free.flat);
  EXPECT_GT(free.stretch, 1.001);
  EXPECT_GT(free.energy, 0);
  EXPECT_TRUE(Trial(surface, free.stretch + 1e-6).flat);
  EXPECT_FALSE(Trial(surface, 1 + (free.stretch - 1) / 2).flat);
}

// KnownTrials relies on it.
TEST(ChartTrial, ABoundThatHoldsChangesNothing) {
  const TestSurface surface(shapes::SphericalCap(10, 1.1));
  const ChartPatch patch = surface.WholePatch();
  const TrialFlattening free = TrialFlatten(patch.mesh);
  for (double more : {1e-9, 0.01, 1.0}) {
    TrialFlattening map;
    EXPECT_TRUE(TryChart(
                    patch, free.l2_stretch + more, [] {}, &map)
                    .flat);
    EXPECT_EQ(map.uv, free.uv) << more;
    EXPECT_EQ(map.energy, free.energy);
    KnownTrials known;
    known.Add(patch.faces, map);
    ASSERT_NE(known.Find(patch.faces), nullptr);
    EXPECT_EQ(known.Find(patch.faces)->uv, free.uv);
    EXPECT_EQ(known.Find({patch.faces.begin(), patch.faces.end() - 1}), nullptr);
  }
  TrialFlattening map;
  EXPECT_FALSE(TryChart(
                   patch, 1 + (free.l2_stretch - 1) / 2, [] {}, &map)
                   .flat);
  KnownTrials known;
  known.Add(patch.faces, map);
  EXPECT_EQ(known.Find(patch.faces), nullptr) << "it was given up";
}

TEST(ChartTrial, ALargerCapCostsMore) {
  double last = 0;
  for (double angle : {0.3, 0.6, 0.9, 1.2}) {
    const double energy = Trial(TestSurface(shapes::SphericalCap(8, angle))).energy;
    EXPECT_GT(energy, last) << angle;
    last = energy;
  }
}

TEST(ChartTrial, WhatOverlapsItselfIsNotFlat) {
  for (double turns : {0.5, 1.5}) {
    const ChartTrial trial = Trial(TestSurface(test::Ramp(turns)));
    EXPECT_EQ(trial.flat, turns < 1);
    EXPECT_LT(trial.stretch, 1.01);
    EXPECT_GE(trial.stretch, 1);
  }
}

}  // namespace
}  // namespace dcharts
