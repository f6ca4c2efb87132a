// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/trial_flatten.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/pi.h"
#include "flatten_charts.h"
#include "planar/distortion.h"
#include "planar/flatten.h"

namespace dcharts {
namespace {

ChartMesh Saddle() { return GridChart(12, 12, SaddlePoint); }

TEST(TrialFlatten, IsCloseToTheFullFlattening) {
  for (const ChartMesh& chart : {Saddle(), SphereCap(12, 0.6), SphereCap(14, 1.4)}) {
    const TrialFlattening trial = TrialFlatten(chart);
    FlattenOptions options;
    options.linf_finish = false;
    const Flattening full = Flatten(chart, options);
    ASSERT_TRUE(trial.ok) << trial.why;
    ASSERT_TRUE(full.ok) << full.why;
    EXPECT_GT(trial.l2_stretch - 1, 0.99 * (full.l2_stretch - 1));
    EXPECT_LT(trial.l2_stretch - 1, 1.1 * (full.l2_stretch - 1));
    EXPECT_GT(trial.energy, 0);
    const StretchFigures figures = MeasureStretch(chart, trial.uv);
    EXPECT_EQ(figures.FlippedOrDegenerate(), 0);
    EXPECT_NEAR(figures.L2(), trial.l2_stretch, 1e-9);
    EXPECT_NEAR(figures.Linf(), trial.linf_stretch, 1e-9);
    EXPECT_NEAR(figures.UvArea(), figures.SurfaceArea(), 1e-9 * figures.SurfaceArea());
  }
}

TEST(TrialFlatten, TheBoundDecides) {
  const ChartMesh chart = SphereCap(14, 1.4);
  const double stretch = TrialFlatten(chart).l2_stretch;
  TrialOptions options;
  for (const bool decide_only : {false, true}) {
    options.decide_only = decide_only;
    for (const double factor : {1.1, 1.5, 10.0}) {
      options.l2_bound = 1 + factor * (stretch - 1);
      const TrialFlattening trial = TrialFlatten(chart, options);
      EXPECT_TRUE(trial.ok);
      EXPECT_LE(trial.l2_stretch, options.l2_bound);
    }
    for (const double factor : {0.9, 0.5, 0.01}) {
      options.l2_bound = 1 + factor * (stretch - 1);
      const TrialFlattening trial = TrialFlatten(chart, options);
      EXPECT_FALSE(trial.ok);
      EXPECT_TRUE(trial.rejected);
      EXPECT_GT(trial.l2_stretch, options.l2_bound);
    }
  }
}

TEST(TrialFlatten, AHopelessStartIsNotImproved) {
  const ChartMesh finger = Tube(12, 20, true, [](double angle, int ring) -> Eigen::RowVector3d {
    return {std::cos(angle), std::sin(angle), 0.5 * ring};
  });
  int steps = 0;
  const auto count_steps = [&steps] { ++steps; };
  TrialOptions options;
  options.l2_bound = 1e6;
  EXPECT_GT(TrialFlatten(finger, options, count_steps).l2_stretch, 1.5);
  const int steps_to_improve = steps;
  steps = 0;
  options.l2_bound = 1.4;
  const TrialFlattening trial = TrialFlatten(finger, options, count_steps);
  EXPECT_TRUE(trial.rejected);
  EXPECT_FALSE(trial.ok);
  EXPECT_GT(trial.l2_stretch, 1.5);
  EXPECT_LT(steps, steps_to_improve);
}

TEST(TrialFlatten, StartsFromUvsWithoutFlips) {
  const ChartMesh chart = SphereCap(14, 1.4);
  const Flattening full = Flatten(chart);
  TrialOptions options;
  options.newton_steps = 0;
  options.start = &full.uv;
  EXPECT_NEAR(TrialFlatten(chart, options).l2_stretch, full.l2_stretch, 1e-9);

  Points2 flipped = full.uv;
  flipped.col(0) *= -1;
  options.start = &flipped;
  const TrialFlattening trial = TrialFlatten(chart, options);
  ASSERT_TRUE(trial.ok);
  EXPECT_EQ(MeasureStretch(chart, trial.uv).FlippedOrDegenerate(), 0);
}

// A flat ring one and a half times around: its ends lie on each other.
ChartMesh LongRing(double turns) {
  return GridChart(60, 8, [&](double u, double v) {
    const double angle = turns * 2 * kPi * u, radius = 2 + v;
    return Eigen::RowVector3d(radius * std::cos(angle), radius * std::sin(angle), 0.05 * angle);
  });
}

TEST(TrialFlatten, OverlapsAreRefusedOnRequest) {
  TrialOptions options;
  for (const bool no_overlap : {false, true}) {
    options.no_overlap = no_overlap;
    EXPECT_TRUE(TrialFlatten(LongRing(0.7), options).ok);
    const TrialFlattening trial = TrialFlatten(LongRing(1.4), options);
    EXPECT_EQ(trial.ok, !no_overlap);
    EXPECT_FALSE(trial.rejected);
    EXPECT_EQ(trial.overlaps, no_overlap ? kClearOverlap : 0u);
  }
}

TEST(TrialFlatten, SaysWhyThereIsNoMap) {
  ChartMesh sphere = SphereCap(6, 1.0);
  sphere.triangles.row(0).swap(sphere.triangles.row(1));
  sphere.triangles.row(0).reverseInPlace();
  const TrialFlattening broken = TrialFlatten(sphere);
  EXPECT_FALSE(broken.ok);
  EXPECT_FALSE(broken.rejected);
  EXPECT_FALSE(broken.why.empty());

  const ChartMesh point = GridChart(2, 2, [](double, double) { return Eigen::RowVector3d(1, 2, 3); });
  EXPECT_FALSE(TrialFlatten(point).ok);
  EXPECT_FALSE(TrialFlatten(point).why.empty());
}

}  // namespace
}  // namespace dcharts
