// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/flatten.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "flatten_charts.h"
#include "planar/distortion.h"

namespace dcharts {
namespace {

double UvArea(const Triangles& triangles, const Points2& uv) {
  double sum = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::RowVector2d a = uv.row(triangles(t, 1)) - uv.row(triangles(t, 0));
    const Eigen::RowVector2d b = uv.row(triangles(t, 2)) - uv.row(triangles(t, 0));
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

double SurfaceArea(const ChartMesh& chart) {
  double sum = 0;
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    const Eigen::Vector3d a =
        (chart.positions.row(chart.triangles(t, 1)) - chart.positions.row(chart.triangles(t, 0))).transpose();
    const Eigen::Vector3d b =
        (chart.positions.row(chart.triangles(t, 2)) - chart.positions.row(chart.triangles(t, 0))).transpose();
    sum += 0.5 * a.cross(b).norm();
  }
  return sum;
}

int FlippedTriangles(const Triangles& triangles, const Points2& uv) {
  int flipped = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::RowVector2d a = uv.row(triangles(t, 1)) - uv.row(triangles(t, 0));
    const Eigen::RowVector2d b = uv.row(triangles(t, 2)) - uv.row(triangles(t, 0));
    if (!(a.x() * b.y() - a.y() * b.x() > 0)) ++flipped;
  }
  return flipped;
}

// What hosts store: `share` of the unit square's side, in float32.
Points2 Rounded(const Points2& uv, double share) {
  const Eigen::RowVector2d low = uv.colwise().minCoeff(), high = uv.colwise().maxCoeff();
  const Points2 unit = (uv.rowwise() - low) * (share / (high - low).maxCoeff());
  const Points2 moved = (unit.array() + (1 - share)).matrix();
  return moved.cast<float>().cast<double>();
}

void ExpectSound(const ChartMesh& chart, const Flattening& flat) {
  ASSERT_TRUE(flat.ok) << flat.why;
  EXPECT_TRUE(flat.why.empty());
  ASSERT_EQ(flat.uv.rows(), chart.positions.rows());
  EXPECT_TRUE(flat.uv.allFinite());
  EXPECT_EQ(FlippedTriangles(chart.triangles, flat.uv), 0);
  EXPECT_EQ(FlippedTriangles(chart.triangles, Rounded(flat.uv, 1.0)), 0);
  EXPECT_EQ(FlippedTriangles(chart.triangles, Rounded(flat.uv, 0.25)), 0);
  EXPECT_NEAR(UvArea(chart.triangles, flat.uv) / SurfaceArea(chart), 1, 1e-2);
  const StretchFigures figures = MeasureStretch(chart, flat.uv);
  EXPECT_NEAR(figures.UvArea() / figures.SurfaceArea(), 1, 1e-9);
  EXPECT_NEAR(figures.L2(), flat.l2_stretch, 1e-9 * flat.l2_stretch);
  EXPECT_NEAR(figures.Linf(), flat.linf_stretch, 1e-6 * flat.linf_stretch);
  EXPECT_GE(flat.l2_stretch, 1 - 1e-9);
}

void ExpectIsometric(const ChartMesh& chart) {
  const Flattening flat = Flatten(chart);
  ExpectSound(chart, flat);
  EXPECT_NEAR(flat.l2_stretch, 1, 1e-6);
  EXPECT_NEAR(flat.linf_stretch, 1, 1e-6);
}

bool SameBytes(const Points2& a, const Points2& b) {
  return a.rows() == b.rows() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

TEST(Flatten, PlaneIsIsometric) { ExpectIsometric(GridChart(20, 10, PlanePoint)); }

TEST(Flatten, PlaneWithHolesIsIsometric) {
  ExpectIsometric(
      GridChart(30, 30, PlanePoint, [](int i, int j) { return !(i > 10 && i < 20 && j > 8 && j < 15); }));
  ExpectIsometric(GridChart(60, 30, PlanePoint,
                            [](int i, int j) { return !(i % 10 > 5 && i % 10 < 9 && j > 8 && j < 15); }));
}

TEST(Flatten, FlatRingIsIsometric) {
  ExpectIsometric(
      GridChart(12, 12, PlanePoint, [](int i, int j) { return i < 1 || i > 10 || j < 1 || j > 10; }));
}

TEST(Flatten, UnrolledCylindersAreIsometric) {
  for (const double turn : {kTestPi, 6.1}) {
    ExpectIsometric(GridChart(60, 20, [turn](double x, double y) -> Eigen::RowVector3d {
      return {std::cos(turn * x), std::sin(turn * x), 2 * y};
    }));
  }
}

TEST(Flatten, ConeSectorIsIsometric) {
  // Of a polyhedral cone: planar quads, so that the triangles themselves unroll.
  ExpectIsometric(GridChart(40, 20, [](double x, double y) -> Eigen::RowVector3d {
    const double r = 0.1 + y;
    return {r * std::cos(5 * x), r * std::sin(5 * x), 2 * r};
  }));
}

TEST(Flatten, LongThinTrianglesUnrollToo) {
  ExpectIsometric(GridChart(200, 1, [](double x, double y) -> Eigen::RowVector3d {
    return {std::cos(6 * x), std::sin(6 * x), 200 * y};
  }));
}

// The L2 stretch of a hemisphere under the map that sends the polar angle t to the radius r(t), from its
// singular values UV -> sphere, 1 / r' and sin t / r.
double HemisphereStretch(double (*radius)(double), double (*slope)(double)) {
  const int steps = 20000;
  double squares = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps * kTestPi / 2;
    const double g1 = 1 / slope(t), g2 = std::sin(t) / radius(t);
    squares += 0.5 * (g1 * g1 + g2 * g2) * std::sin(t) * kTestPi / 2 / steps;
  }
  const double rim = radius(kTestPi / 2);
  return std::sqrt(squares * rim * rim / 2);
}

TEST(Flatten, HemisphereBeatsClassicalProjections) {
  FlattenOptions options;
  options.linf_finish = false;
  const ChartMesh chart = SphereCap(60, kTestPi / 2);
  const Flattening flat = Flatten(chart, options);
  ExpectSound(chart, flat);
  const double equidistant = HemisphereStretch([](double t) { return t; }, [](double) { return 1.0; });
  const double stereographic = HemisphereStretch([](double t) { return 2 * std::tan(t / 2); },
                                                 [](double t) { return 1 / std::pow(std::cos(t / 2), 2); });
  const double equal_area = HemisphereStretch([](double t) { return 2 * std::sin(t / 2); },
                                              [](double t) { return std::cos(t / 2); });
  EXPECT_LT(flat.l2_stretch, equidistant);
  EXPECT_LT(flat.l2_stretch, stereographic);
  EXPECT_LT(flat.l2_stretch, equal_area);
  EXPECT_GT(flat.l2_stretch, 1.01);
  EXPECT_LT(flat.linf_stretch, 1.2);
}

TEST(Flatten, NearlyClosedSphereDoesNotFlip) {
  const ChartMesh chart = SphereCap(50, kTestPi * 170 / 180);
  const Flattening flat = Flatten(chart);
  ExpectSound(chart, flat);
  EXPECT_LT(flat.l2_stretch, 1.4);
}

TEST(Flatten, LinfFinishLowersTheWorstStretchAtLittleCost) {
  FlattenOptions without;
  without.linf_finish = false;
  const ChartMesh chart = SphereCap(30, 2.0);
  const Flattening mean = Flatten(chart, without), worst = Flatten(chart);
  ExpectSound(chart, mean);
  ExpectSound(chart, worst);
  EXPECT_LT(worst.linf_stretch - 1, 0.9 * (mean.linf_stretch - 1));
  EXPECT_LE(worst.l2_stretch - 1, 1.1 * (mean.l2_stretch - 1) + 1e-12);
}

TEST(Flatten, LinfFinishKeepsWithinABoundOnTheMean) {
  const ChartMesh chart = SphereCap(30, 2.0);
  FlattenOptions without, free, bounded;
  without.linf_finish = false;
  const double mean = Flatten(chart, without).l2_stretch, most = Flatten(chart, free).l2_stretch;
  ASSERT_GT(most, mean);
  bounded.l2_bound = 0.5 * (mean + most);
  EXPECT_LE(Flatten(chart, bounded).l2_stretch, bounded.l2_bound);
  // A chart above it already pays as it would without a bound.
  bounded.l2_bound = 0.5 * (1 + mean);
  EXPECT_EQ(Flatten(chart, bounded).l2_stretch, most);
}

// What is stretched most is in one place: the rest hardly hears of it.
TEST(Flatten, LinfFinishOfOneSteepPlace) {
  const ChartMesh chart = GridChart(40, 40, [](double x, double y) -> Eigen::RowVector3d {
    const double square = (x - 0.3) * (x - 0.3) + (y - 0.4) * (y - 0.4);
    return {x, y, 0.1 * std::exp(-150 * square)};
  });
  FlattenOptions without;
  without.linf_finish = false;
  const Flattening mean = Flatten(chart, without), worst = Flatten(chart);
  ExpectSound(chart, worst);
  EXPECT_LT(worst.linf_stretch - 1, 0.85 * (mean.linf_stretch - 1));
  EXPECT_LE(worst.l2_stretch - 1, 1.2 * (mean.l2_stretch - 1) + 1e-12);
}

TEST(Flatten, GoesOnFromAStart) {
  const ChartMesh chart = SphereCap(30, 1.5);
  FlattenOptions options;
  options.linf_finish = false;
  const Flattening flat = Flatten(chart, options);
  // The same after it was squeezed, but not from a flipped one, of which nothing is taken.
  Points2 squeezed = flat.uv, flipped = flat.uv;
  squeezed.col(0) *= 0.8;
  flipped.col(0) *= -1;
  options.start = &squeezed;
  const Flattening again = Flatten(chart, options);
  ExpectSound(chart, again);
  EXPECT_NEAR(again.l2_stretch, flat.l2_stretch, 0.01 * (flat.l2_stretch - 1));
  options.start = &flipped;
  EXPECT_EQ(Flatten(chart, options).uv, flat.uv);
}

TEST(Flatten, TubeWithTwoLoopsOpensAsARing) {
  const ChartMesh chart = Tube(24, 8, false, [](double angle, int ring) -> Eigen::RowVector3d {
    const double r = 1 + 0.1 * ring;
    return {r * std::cos(angle), r * std::sin(angle), 0.03 * ring};
  });
  const Flattening flat = Flatten(chart);
  ExpectSound(chart, flat);
  EXPECT_LT(flat.l2_stretch, 1.01);
}

TEST(Flatten, SliversAndZeroAreaTriangles) {
  for (const double thickness : {1e-3, 1e-5, 1e-8, 0.0}) {
    ChartMesh chart = GridChart(20, 20, SaddlePoint);
    std::mt19937 random(5);
    for (int i = 0; i < 60; ++i) {
      const Eigen::Index t = random() % static_cast<unsigned>(chart.triangles.rows());
      const Eigen::RowVector3d middle =
          0.5 * (chart.positions.row(chart.triangles(t, 1)) + chart.positions.row(chart.triangles(t, 2)));
      const int apex = chart.triangles(t, 0);
      chart.positions.row(apex) = (1 - thickness) * middle + thickness * chart.positions.row(apex);
    }
    const Flattening flat = Flatten(chart);
    SCOPED_TRACE(thickness);
    ExpectSound(chart, flat);
    EXPECT_LT(flat.l2_stretch, 1.02);
  }
}

TEST(Flatten, CoincidentVertices) {
  ChartMesh chart = GridChart(30, 30, SaddlePoint);
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Index t = random() % static_cast<unsigned>(chart.triangles.rows());
    const int k = static_cast<int>(random() % 3);
    chart.positions.row(chart.triangles(t, k)) = chart.positions.row(chart.triangles(t, (k + 1) % 3)).eval();
  }
  const Flattening flat = Flatten(chart);
  ExpectSound(chart, flat);
}

TEST(Flatten, NoisySheets) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double noise = 0.002 * std::pow(4.0, seed);
    const ChartMesh chart = GridChart(25, 25, [&](double x, double y) -> Eigen::RowVector3d {
      return SaddlePoint(x, y) +
             noise * Eigen::RowVector3d(uniform(random), uniform(random), uniform(random));
    });
    SCOPED_TRACE(seed);
    ExpectSound(chart, Flatten(chart));
  }
}

TEST(Flatten, ChartWithoutAreaGetsALayout) {
  for (const double length : {0.0, 1.0}) {
    const ChartMesh chart = GridChart(6, 6, [length](double x, double) -> Eigen::RowVector3d {
      return {1 + length * x, 1, 1};
    });
    const Flattening flat = Flatten(chart);
    ASSERT_TRUE(flat.ok) << flat.why;
    EXPECT_TRUE(flat.uv.allFinite());
    EXPECT_EQ(FlippedTriangles(chart.triangles, flat.uv), 0);
    EXPECT_EQ(flat.l2_stretch, 1);
    EXPECT_EQ(flat.linf_stretch, 1);
  }
}

TEST(Flatten, OneAndTwoTriangles) {
  ChartMesh one;
  one.positions.resize(3, 3);
  one.positions << 0, 0, 0, 3, 0, 1, 0, 1, 0;
  one.triangles.resize(1, 3);
  one.triangles << 0, 1, 2;
  ExpectIsometric(one);
  ChartMesh two;
  two.positions.resize(4, 3);
  two.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 5;
  two.triangles.resize(2, 3);
  two.triangles << 0, 1, 2, 1, 3, 2;
  ExpectIsometric(two);
}

TEST(Flatten, SizeAndPlaceDoNotMatter) {
  const Flattening reference = Flatten(GridChart(20, 20, SaddlePoint));
  for (const double size : {1e-150, 1e-20, 1e-3, 1e20, 1e150}) {
    const ChartMesh chart = GridChart(
        20, 20, [size](double x, double y) -> Eigen::RowVector3d { return size * SaddlePoint(x, y); });
    const Flattening flat = Flatten(chart);
    SCOPED_TRACE(size);
    ASSERT_TRUE(flat.ok) << flat.why;
    EXPECT_EQ(FlippedTriangles(chart.triangles, Rounded(flat.uv, 1.0)), 0);
    EXPECT_NEAR(flat.l2_stretch, reference.l2_stretch, 1e-9);
    EXPECT_NEAR((flat.uv / size - reference.uv).cwiseAbs().maxCoeff(), 0, 1e-6);
  }
  const ChartMesh far = GridChart(20, 20, [](double x, double y) -> Eigen::RowVector3d {
    return SaddlePoint(x, y) + Eigen::RowVector3d(1e6, -1e6, 1e6);
  });
  const Flattening flat = Flatten(far);
  ExpectSound(far, flat);
  EXPECT_NEAR(flat.l2_stretch, reference.l2_stretch, 1e-7);
}

TEST(Flatten, TurningTheChartDoesNotMatter) {
  const ChartMesh chart = SphereCap(20, 1.2);
  ChartMesh turned = chart;
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  turned.positions = (chart.positions * rotation.transpose()).eval();
  const Flattening a = Flatten(chart), b = Flatten(turned);
  ExpectSound(turned, b);
  EXPECT_NEAR(a.l2_stretch, b.l2_stretch, 1e-5 * (a.l2_stretch - 1));
  EXPECT_NEAR(a.linf_stretch, b.linf_stretch, 1e-3 * (a.linf_stretch - 1));
}

TEST(Flatten, SameBytesEveryTimeAndInEveryThread) {
  const ChartMesh chart = SphereCap(16, 2.2);
  const Flattening reference = Flatten(chart);
  ASSERT_TRUE(reference.ok);
  std::vector<Flattening> results(4);
  std::vector<std::thread> threads;
  for (Flattening& result : results) {
    threads.emplace_back([&chart, &result] { result = Flatten(chart); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Flattening& result : results) EXPECT_TRUE(SameBytes(result.uv, reference.uv));
}

TEST(Flatten, ClosedFingers) {
  const auto finger = [](int rings) {
    return Tube(12, rings, true, [](double angle, int ring) -> Eigen::RowVector3d {
      return {0.2 * std::cos(angle), 0.2 * std::sin(angle), 0.1 * ring};
    });
  };
  const ChartMesh short_finger = finger(20);
  ExpectSound(short_finger, Flatten(short_finger));
  // 400 rings: Tutte's embedding has no digits left for the tip.
  const Flattening flat = Flatten(finger(400));
  EXPECT_FALSE(flat.ok);
  EXPECT_EQ(flat.uv.size(), 0);
  EXPECT_NE(flat.why.find("cut"), std::string::npos) << flat.why;
}

TEST(Flatten, WhatIsNoChartIsRefusedWithAReason) {
  ChartMesh tetrahedron;
  tetrahedron.positions.resize(4, 3);
  tetrahedron.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  tetrahedron.triangles.resize(4, 3);
  tetrahedron.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  const Flattening closed = Flatten(tetrahedron);
  EXPECT_FALSE(closed.ok);
  EXPECT_NE(closed.why.find("closed"), std::string::npos) << closed.why;

  ChartMesh broken = GridChart(3, 3, PlanePoint);
  broken.positions(4, 1) = std::nan("");
  EXPECT_FALSE(Flatten(broken).ok);
  EXPECT_FALSE(Flatten(broken).why.empty());

  ChartMesh flipped = GridChart(3, 3, PlanePoint);
  std::swap(flipped.triangles(0, 0), flipped.triangles(0, 1));
  EXPECT_FALSE(Flatten(flipped).ok);

  EXPECT_FALSE(Flatten(ChartMesh()).ok);
}

TEST(Flatten, PollStopsTheWork) {
  struct Stop : std::runtime_error {
    Stop() : std::runtime_error("stop") {}
  };
  int calls = 0;
  const ChartMesh chart = SphereCap(10, 1.5);
  EXPECT_THROW(Flatten(chart, {},
                       [&calls] {
                         if (++calls == 3) throw Stop();
                       }),
               Stop);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace dcharts
