// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/abf.h"

#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "flatten_charts.h"
#include "planar/flatten.h"

namespace dcharts {
namespace {

FlattenOptions Conformal() {
  FlattenOptions options;
  options.method = FlattenMethod::kConformal;
  return options;
}

Points3 Lifted(const Points2& uv) {
  Points3 points = Points3::Zero(uv.rows(), 3);
  points.leftCols(2) = uv;
  return points;
}

double Angle(const Points3& points, int at, int from, int to) {
  const Eigen::Vector3d a = (points.row(from) - points.row(at)).transpose();
  const Eigen::Vector3d b = (points.row(to) - points.row(at)).transpose();
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Mean squared difference of corner angles between surface and plane, rad^2.
double AngleError(const ChartMesh& chart, const Points2& uv) {
  const Points3 flat = Lifted(uv);
  double sum = 0;
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = chart.triangles(t, k), b = chart.triangles(t, (k + 1) % 3),
                c = chart.triangles(t, (k + 2) % 3);
      const double difference = Angle(chart.positions, a, b, c) - Angle(flat, a, b, c);
      sum += difference * difference;
    }
  }
  return sum / (3 * static_cast<double>(chart.triangles.rows()));
}

double Area(const Triangles& triangles, const Points3& points) {
  double area = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::Vector3d a = (points.row(triangles(t, 1)) - points.row(triangles(t, 0))).transpose();
    const Eigen::Vector3d b = (points.row(triangles(t, 2)) - points.row(triangles(t, 0))).transpose();
    area += 0.5 * a.cross(b).norm();
  }
  return area;
}

void ExpectNoFlip(const ChartMesh& chart, const Flattening& flat) {
  ASSERT_TRUE(flat.ok) << flat.why;
  ASSERT_TRUE(flat.uv.allFinite());
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    const Eigen::RowVector2d corner = flat.uv.row(chart.triangles(t, 0));
    const Eigen::RowVector2d e1 = flat.uv.row(chart.triangles(t, 1)) - corner;
    const Eigen::RowVector2d e2 = flat.uv.row(chart.triangles(t, 2)) - corner;
    ASSERT_GT(e1.x() * e2.y() - e1.y() * e2.x(), 0) << "triangle " << t;
  }
}

// Flips, area, and that it is the conformal map.
Flattening SoundConformal(const ChartMesh& chart) {
  const Flattening flat = Flatten(chart, Conformal());
  ExpectNoFlip(chart, flat);
  EXPECT_EQ(flat.note, "");
  if (flat.ok) {
    const double area = Area(chart.triangles, chart.positions);
    EXPECT_NEAR(Area(chart.triangles, Lifted(flat.uv)), area, 1e-9 * area);
    EXPECT_GE(flat.l2_stretch, 1 - 1e-9);
    EXPECT_GE(flat.linf_stretch, flat.l2_stretch * (1 - 1e-9));
  }
  return flat;
}

// Least squares on the surface's own angles, without any step on them.
Points2 LeastSquares(const ChartMesh& chart) {
  ChartMesh unit = chart;
  unit.positions /= std::sqrt(Area(chart.triangles, chart.positions));
  VertexBlockSystem system(static_cast<int>(chart.positions.rows()), unit.triangles);
  const AngleFlattening flattening(unit, RestShapesOf(unit), 1e-4);
  const std::optional<PlanePoints> map = flattening.LayOut(system);
  Points2 uv = Points2::Zero(chart.positions.rows(), 2);
  if (!map) return uv;
  for (std::size_t v = 0; v < map->size(); ++v) {
    uv.row(static_cast<Eigen::Index>(v)) << (*map)[v].real(), (*map)[v].imag();
  }
  return uv;
}

// Uneven spacing, so that triangles have all kinds of shapes.
double Warped(double x) { return x + 0.12 * std::sin(7 * x); }

Eigen::RowVector3d Cylinder(double x, double y) {
  const double angle = 5 * Warped(x);
  return {std::cos(angle), std::sin(angle), 1.5 * Warped(y)};
}

Eigen::RowVector3d Cone(double x, double y) {
  const double r = 0.2 + Warped(y), angle = 4.5 * Warped(x);
  return {r * std::cos(angle), r * std::sin(angle), 1.5 * r};
}

// Two faces of a cube.
Eigen::RowVector3d CubeEdge(double x, double y) {
  if (x <= 0.5) return {2 * x, y, 0};
  return {1, y, 2 * x - 1};
}

Eigen::RowVector3d Bumps(double x, double y) { return {x, y, 0.06 * std::sin(20 * x) * std::cos(17 * y)}; }

ChartMesh NoisySheet(double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  const auto noise = [&] { return amplitude * (static_cast<double>(random()) / 2147483648.0 - 1); };
  return GridChart(24, 24, [&](double x, double y) -> Eigen::RowVector3d {
    const double a = noise(), b = noise(), c = noise();
    return {x + a, y + b, c};
  });
}

TEST(Abf, DevelopableChartsKeepTheirAngles) {
  const std::vector<ChartMesh> charts = {
      GridChart(30, 20, Cylinder), GridChart(30, 20, Cone), GridChart(20, 10, CubeEdge),
      GridChart(
          20, 20, [](double x, double y) { return PlanePoint(Warped(x), Warped(y)); },
          [](int i, int j) { return i < 6 || i > 11 || j < 5 || j > 12; })};
  for (const ChartMesh& chart : charts) {
    const Flattening flat = SoundConformal(chart);
    ASSERT_TRUE(flat.ok);
    EXPECT_LE(AngleError(chart, flat.uv), 1e-12);
    EXPECT_LE(flat.linf_stretch, 1 + 1e-5);
  }
}

TEST(Abf, ConeApexInsideAChartIsTheLeastChangeOfItsAngles) {
  // A pyramid of 5 equal triangles: by symmetry each angle at the apex becomes 72 degrees.
  ChartMesh chart;
  chart.positions.resize(6, 3);
  chart.triangles.resize(5, 3);
  chart.positions.row(0) << 0, 0, 1;
  for (int k = 0; k < 5; ++k) {
    chart.positions.row(k + 1) << std::cos(2 * kTestPi * k / 5), std::sin(2 * kTestPi * k / 5), 0;
    chart.triangles.row(k) << 0, k + 1, (k + 1) % 5 + 1;
  }
  const Flattening flat = SoundConformal(chart);
  ASSERT_TRUE(flat.ok);
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(Angle(Lifted(flat.uv), 0, k + 1, (k + 1) % 5 + 1), 2 * kTestPi / 5, 1e-8);
    EXPECT_NEAR(Angle(Lifted(flat.uv), k + 1, (k + 1) % 5 + 1, 0), 0.3 * kTestPi, 1e-8);
  }
}

TEST(Abf, CurvedChartsChangeAnglesLessThanLeastSquaresAndThanLeastStretch) {
  const std::vector<ChartMesh> charts = {SphereCap(24, kTestPi / 2), SphereCap(24, 2.4),
                                         GridChart(40, 40, Bumps), GridChart(20, 20, SaddlePoint),
                                         NoisySheet(0.01, 5)};
  for (const ChartMesh& chart : charts) {
    const Flattening flat = SoundConformal(chart);
    ASSERT_TRUE(flat.ok);
    const double error = AngleError(chart, flat.uv);
    EXPECT_LT(error, AngleError(chart, LeastSquares(chart)));
    EXPECT_LT(error, AngleError(chart, Flatten(chart).uv));
  }
}

TEST(Abf, AnglesConvergeInAFewSteps) {
  ChartMesh chart = SphereCap(24, 2.0);
  chart.positions /= std::sqrt(Area(chart.triangles, chart.positions));
  VertexBlockSystem system(static_cast<int>(chart.positions.rows()), chart.triangles);
  AngleFlattening flattening(chart, RestShapesOf(chart), 1e-4);
  for (int step = 0; step < 5; ++step) ASSERT_TRUE(flattening.Step(system));
  EXPECT_LT(flattening.LastStep(), 1e-8);
}

TEST(Abf, AMapTooFineForTextureCoordinatesIsReplacedAndSaysSo) {
  // The tip of a long closed finger shrinks by e per radius in a conformal map.
  const auto finger = [](double angle, int ring) -> Eigen::RowVector3d {
    return {std::cos(angle), std::sin(angle), 0.3 * ring};
  };
  const ChartMesh chart = Tube(20, 60, true, finger);
  const Flattening flat = Flatten(chart, Conformal());
  ExpectNoFlip(chart, flat);
  EXPECT_NE(flat.note.find("flattened with least stretch instead"), std::string::npos);
  EXPECT_EQ(flat.uv, Flatten(chart).uv);
}

TEST(Abf, AMapThatFoldsIsReplacedAndSaysSo) {
  // From end to end of this tube a conformal ring grows by e^19.
  const ChartMesh chart = Tube(20, 20, false, [](double angle, int ring) -> Eigen::RowVector3d {
    return {std::cos(angle), std::sin(angle), 1.0 * ring};
  });
  const Flattening flat = Flatten(chart, Conformal());
  ExpectNoFlip(chart, flat);
  EXPECT_EQ(flat.note, "its conformal map folds, flattened with least stretch instead");
  EXPECT_EQ(flat.uv, Flatten(chart).uv);
}

TEST(Abf, AnUncutTubeBecomesARing) {
  // The wall of a cylinder is one half of the logarithm's picture: rings of equal height in space have radii
  // in a geometric sequence in the plane.
  constexpr int kAround = 48, kRings = 20;
  constexpr double kHeight = 0.125;
  const ChartMesh chart = Tube(kAround, kRings, false, [](double angle, int ring) -> Eigen::RowVector3d {
    return {std::cos(angle), std::sin(angle), kHeight * ring};
  });
  const Flattening flat = SoundConformal(chart);
  ASSERT_TRUE(flat.ok);
  EXPECT_LT(AngleError(chart, flat.uv), 4e-3);  // of rectangles that become trapezoids
  std::vector<double> radius;
  for (int ring = 0; ring < kRings; ++ring) {
    const auto points = flat.uv.middleRows(ring * kAround, kAround);
    radius.push_back((points.rowwise() - points.colwise().mean()).rowwise().norm().mean());
  }
  for (std::size_t ring = 1; ring < radius.size(); ++ring) {
    EXPECT_NEAR(std::abs(std::log(radius[ring] / radius[ring - 1])), kHeight, 0.02 * kHeight);
  }
}

TEST(Abf, HolesThatFanTrianglesCannotFillStayExact) {
  // A flat sheet with a hole like a C.
  const ChartMesh chart = GridChart(12, 12, PlanePoint, [](int i, int j) {
    return !(i >= 3 && i <= 8 && j >= 3 && j <= 8 && (i <= 4 || j <= 4 || j >= 7));
  });
  const Flattening flat = SoundConformal(chart);
  ASSERT_TRUE(flat.ok);
  EXPECT_LT(AngleError(chart, flat.uv), 1e-12);
}

TEST(Abf, LeastStretchHasNoNote) { EXPECT_EQ(Flatten(SphereCap(10, 1.5)).note, ""); }

TEST(Abf, ZeroAreaTrianglesSliversAndNoiseAreFlattenedWithoutFlips) {
  std::vector<ChartMesh> charts = {SphereCap(16, 1.5), NoisySheet(0.03, 1), NoisySheet(0.1, 2),
                                   NoisySheet(1.0, 3)};
  charts[0].positions.row(140) = charts[0].positions.row(141);
  charts[0].positions.row(60) = charts[0].positions.row(61);
  charts.push_back(GridChart(20, 20, [](double x, double y) -> Eigen::RowVector3d {
    return {x * x * x * x * x * x, y, 0.1 * x * y};
  }));
  for (const ChartMesh& chart : charts) ExpectNoFlip(chart, Flatten(chart, Conformal()));
}

TEST(Abf, SizeAndPlaceOfTheChartDoNotMatter) {
  const ChartMesh chart = SphereCap(16, 1.8);
  const Points2 reference = SoundConformal(chart).uv;
  for (const double size : {1e-30, 1e-6, 1e6, 1e30}) {
    ChartMesh other = chart;
    other.positions *= size;
    const Flattening flat = SoundConformal(other);
    ASSERT_TRUE(flat.ok) << size;
    EXPECT_LT((flat.uv / size - reference).cwiseAbs().maxCoeff(), 1e-8) << size;
  }
  ChartMesh turned = chart;
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  turned.positions = (chart.positions * rotation.transpose()).rowwise() + Eigen::RowVector3d(5, -7, 100);
  const Flattening flat = SoundConformal(turned);
  ASSERT_TRUE(flat.ok);
  EXPECT_NEAR(AngleError(turned, flat.uv), AngleError(chart, reference), 1e-10);
}

TEST(Abf, ThreadsGiveTheSameBytes) {
  const ChartMesh chart = SphereCap(16, 1.8);
  const Points2 reference = Flatten(chart, Conformal()).uv;
  std::vector<Points2> results(3);
  std::vector<std::thread> threads;
  for (Points2& result : results) {
    threads.emplace_back([&chart, &result] { result = Flatten(chart, Conformal()).uv; });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Points2& result : results) EXPECT_EQ(result, reference);
}

TEST(Abf, ObeysThePoll) {
  struct Stop {};
  int calls = 0;
  const auto poll = [&] {
    if (++calls == 3) throw Stop();
  };
  EXPECT_THROW(Flatten(SphereCap(16, 1.8), Conformal(), poll), Stop);
}

}  // namespace
}  // namespace dcharts
