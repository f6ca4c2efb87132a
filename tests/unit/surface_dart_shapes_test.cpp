// SPDX-License-Identifier: GPL-3.0-or-later
/// Number, place and length of darts on shapes for which one can say them. The cone's are in
/// surface_cut_test.cpp (OpenConeGetsOneDartToItsApex).
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "planar/cone_proxy.h"
#include "planar/flatten.h"
#include "surface/cut.h"
#include "surface/stretch_darts.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

struct Dart {
  Eigen::Vector3d tip;
  double length;  // both in input units
};

Eigen::Vector3d InputPoint(const TestSurface& surface, int vertex) {
  const auto& p = surface.InputPosition(vertex);
  return {p[0], p[1], p[2]};
}

// Cuts that hang together are one dart; its tip is its end inside the surface. `edges`: half-edges.
std::vector<Dart> DartsOf(const TestSurface& surface, const std::vector<int>& edges) {
  std::vector<char> on_border(surface->VertexCount(), 0);
  for (int h = 0; h < surface->HalfEdgeCount(); ++h)
    if (surface->Opposite(h) < 0) on_border[surface->Vertex(h)] = on_border[surface->Vertex(Next(h))] = 1;
  std::map<int, std::vector<int>> at;
  for (int h : edges)
    for (int v : {surface->Vertex(h), surface->Vertex(Next(h))}) at[v].push_back(h);
  std::vector<Dart> darts;
  for (const auto& [tip, first] : at) {
    if (first.size() != 1 || on_border[tip]) continue;
    Dart dart{InputPoint(surface, tip), 0};
    int v = tip, previous = -1;
    while (!on_border[v]) {
      const auto& here = at.at(v);
      if (here.size() > 2) break;  // another dart starts here
      const int h = here.front() != previous ? here.front() : here.back();
      dart.length += surface->Length(h) / surface.Scale();
      v = surface->Vertex(h) == v ? surface->Vertex(Next(h)) : surface->Vertex(h);
      previous = h;
    }
    darts.push_back(dart);
  }
  return darts;
}

std::vector<Dart> CutInOneChart(const TestSurface& surface, DartMethod by, double fitting_error = 0.2) {
  Params params;
  params.dart_by = by;
  params.dart_fitting_error = fitting_error;
  params.target_charts = 1;
  ChartIds ids(surface->FaceCount(), 0);
  SeamMask seams;
  KnownFlattenings known;
  Progress progress;
  const int count =
      ChartCutter<SurfaceMesh>(*surface, params, progress).Run(ChartsFor::kPattern, ids, seams, known);
  std::vector<int> edges;
  for (int h = 0; h < surface->HalfEdgeCount(); ++h)
    if (surface->Opposite(h) > h && IsSeam(seams, h)) edges.push_back(h);
  const std::vector<Dart> darts = DartsOf(surface, edges);
  EXPECT_EQ(static_cast<int>(darts.size()), count);
  return darts;
}

// A roof with a rounded ridge, 6 long and 1 wide; the ridge hangs through (`bend` above 0: a saddle) or
// arches.
SurfaceData LongRidge(double bend) {
  constexpr double kRound = 0.1;
  SurfaceData mesh = shapes::Grid(72, 12);
  for (auto& p : mesh.vertices) {
    const double x = 6 * (p[0] - 0.5), y = p[1] - 0.5;
    p = {x, y, bend * x * x / 2 - std::sqrt(y * y + kRound * kRound)};
  }
  return mesh;
}

// From the long side up to the ridge, along a row of the grid.
constexpr double kRidgeDart = 0.653;

TEST(DartShapes, ASphericalCapGetsOneToItsPole) {
  const TestSurface cap(shapes::SphericalCap(12, 1.5));
  for (DartMethod by : {DartMethod::kFittingError, DartMethod::kMeasuredStretch}) {
    const std::vector<Dart> darts = CutInOneChart(cap, by, 0.05);
    ASSERT_EQ(darts.size(), 1u);
    EXPECT_LT((darts[0].tip - Eigen::Vector3d(0, 0, 1)).norm(), 1e-6);
    EXPECT_NEAR(darts[0].length, 1.5, 0.01) << "along a meridian";
  }
}

TEST(DartShapes, AFlatterCapGetsNone) {
  const TestSurface cap(shapes::SphericalCap(12, 1));
  EXPECT_TRUE(CutInOneChart(cap, DartMethod::kFittingError, 0.05).empty());
  EXPECT_TRUE(CutInOneChart(cap, DartMethod::kMeasuredStretch).empty());
}

// By fitting error: each cut relieves a disk around its tip as wide as the cut is long.
TEST(DartShapes, ALongRidgeGetsSeveral) {
  constexpr double kError = 0.02;
  for (double bend : {0.6, -0.4}) {
    const TestSurface ridge(LongRidge(bend));
    const std::vector<Dart> darts = CutInOneChart(ridge, DartMethod::kFittingError, kError);
    NormalMoments moments;
    for (int f = 0; f < ridge->FaceCount(); ++f) moments.Add(ridge->Area(f), ridge->Normal(f));
    const ConeProxy proxy = FitCone(moments);
    std::vector<Eigen::Vector3d> strained;  // on the ridge
    double first = 0, last = 0;
    for (int h = 0; h < ridge->HalfEdgeCount(); ++h) {
      const Eigen::Vector3d p = InputPoint(ridge, ridge->Vertex(h));
      if (!(FittingError(proxy, ridge->Normal(h / 3)) > kError) || std::abs(p.y()) > 1e-6) continue;
      strained.push_back(p);
      first = std::min(first, p.x());
      last = std::max(last, p.x());
    }
    ASSERT_GT(last - first, 2);
    EXPECT_GE(darts.size(), std::ceil((last - first) / (2 * kRidgeDart))) << "two radii each at most";
    EXPECT_LE(darts.size(), std::ceil((last - first) / kRidgeDart) + 1) << "one radius each at least";
    for (const Dart& dart : darts) {
      EXPECT_NEAR(dart.tip.y(), 0, 1e-6);
      EXPECT_NEAR(dart.length, kRidgeDart, 0.01);
      for (const Dart& other : darts)
        if (&other != &dart) {
          EXPECT_GT((dart.tip - other.tip).norm(), 0.9 * kRidgeDart);
        }
    }
    for (const Eigen::Vector3d& p : strained) {
      double nearest = 1e9;
      for (const Dart& dart : darts) nearest = std::min(nearest, (dart.tip - p).norm());
      EXPECT_LE(nearest, kRidgeDart + 1e-3) << p.transpose();
    }
  }
}

std::vector<Dart> CutByStretch(const TestSurface& surface, double share_of_stretch, double& before,
                               double& after) {
  const ChartPatch patch = surface.WholePatch();
  const Flattening flat = Flatten(patch.mesh);
  DartGoal goal;
  goal.l2_stretch = 1 + share_of_stretch * (flat.l2_stretch - 1);
  goal.linf_stretch = 10;
  goal.longest = patch.Diagonal();
  const DartedChart chart = CutStretchDarts(patch, goal, [] {}, {&flat});
  std::vector<int> edges;
  for (int h : chart.edges) edges.push_back(patch.SurfaceHalfEdge(h));
  before = flat.l2_stretch;
  after = chart.flat.l2_stretch;
  return DartsOf(surface, edges);
}

TEST(DartShapes, AnArchedRidgeGetsSeveralByStretch) {
  const TestSurface ridge(LongRidge(-0.8));
  double before, after;
  const std::vector<Dart> darts = CutByStretch(ridge, 0.2, before, after);
  EXPECT_GE(darts.size(), 3u);
  EXPECT_LE(darts.size(), 5u);
  EXPECT_LE(after - 1, 0.2 * (before - 1));
  for (const Dart& dart : darts) {
    EXPECT_NEAR(dart.tip.y(), 0, 0.1);
    EXPECT_LE(dart.length, kRidgeDart + 0.01);
    for (const Dart& other : darts)
      if (&other != &dart) {
        EXPECT_GT((dart.tip - other.tip).norm(), 0.9 * kRidgeDart);
      }
  }
}

// A cut into a saddle is a gusset: its sides would come to lie over each other.
TEST(DartShapes, ASaddleRidgeGetsNoneByStretch) {
  double before, after;
  EXPECT_TRUE(CutByStretch(TestSurface(LongRidge(0.6)), 0.2, before, after).empty());
  EXPECT_EQ(before, after);
}

// A round chart is stretched most at its rim; a cut to its middle relieves it more.
TEST(DartShapes, ADeepCapLiesFlatByOneDartBeyondItsPole) {
  const TestSurface cap(shapes::SphericalCap(16, 2));
  double before, after, length = 0;
  for (const Dart& dart : CutByStretch(cap, 0.2, before, after)) length += dart.length;
  EXPECT_GT(before, 1.05);
  EXPECT_LT(after, 1.012);
  EXPECT_LT(length, 3) << "it is 4 across";
}

}  // namespace
}  // namespace dcharts
