// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/straighten_shortest_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "surface/fill.h"
#include "surface/lloyd.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

ChartIds Straightened(const TestSurface& surface, ChartIds ids, const Params& params = {}) {
  Progress progress;
  ShortestPathStraightener<SurfaceMesh>(*surface, params, progress).Run(ids);
  return ids;
}

// In input units.
double BorderLength(const TestSurface& surface, const ChartIds& ids) {
  return SeamLength(*surface, ChartBorders(*surface, ids)) / surface.Scale();
}

// Which quad of an n by n grid a face is in.
int Column(const std::array<double, 3>& p, int n) { return static_cast<int>(p[0] * n); }
int Row(const std::array<double, 3>& p, int n) { return static_cast<int>(p[1] * n); }

TEST(StraightenShortestPath, RaggedBorderOnAPlaneBecomesTheLine) {
  const int n = 20;
  const TestSurface surface(shapes::Grid(n, n));
  // Teeth of one or two quads on both sides of the middle, none at the ends.
  const ChartIds ragged = surface.Paint([&](const auto& p) {
    const int row = Row(p, n);
    const int shift = row == 0 || row == n - 1 ? 0 : (row * 7 % 5) - 2;
    return Column(p, n) < n / 2 + shift ? 0 : 1;
  });
  ASSERT_GT(BorderLength(surface, ragged), 1.5);
  const ChartIds straight = Straightened(surface, ragged);
  EXPECT_NEAR(BorderLength(surface, straight), 1, 1e-9);
  EXPECT_EQ(straight, surface.Paint([&](const auto& p) { return p[0] < 0.5 ? 0 : 1; }));
}

TEST(StraightenShortestPath, StraightBorderStays) {
  const TestSurface surface(shapes::Grid(12, 12));
  const ChartIds ids = surface.Paint([](const auto& p) { return p[0] < 0.5 ? 0 : 1; });
  EXPECT_EQ(Straightened(surface, ids), ids);
}

TEST(StraightenShortestPath, RaggedCircleAroundACylinderBecomesARing) {
  // The border has no end points: min-cut.
  const int n = 24, m = 16;
  const double pi = 3.14159265358979323846;
  SurfaceData tube;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i < n; ++i)
      tube.vertices.push_back({std::cos(2 * pi * i / n) / 2, std::sin(2 * pi * i / n) / 2, 1.5 * j / m});
  auto vertex = [&](int i, int j) { return j * n + i % n; };
  ChartIds ragged;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      tube.faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      tube.faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      const int tooth = i * 5 % 3 - 1;
      for (int k = 0; k < 2; ++k) ragged.push_back(j < m / 2 + tooth ? 0 : 1);
    }
  const TestSurface surface(tube);
  const double ring = n * 2 * std::sin(pi / n) / 2;
  ASSERT_GT(BorderLength(surface, ragged), 1.3 * ring);
  const ChartIds straight = Straightened(surface, ragged);
  EXPECT_NEAR(BorderLength(surface, straight), ring, 1e-9);
  EXPECT_EQ(ChartCount(straight), 2);
  EXPECT_TRUE(test::ChartsAreWhole(*surface, straight));
}

TEST(StraightenShortestPath, NoChartVanishesOrFallsApartAndNoBorderGrows) {
  std::mt19937 random(14);
  for (const SurfaceData& mesh :
       {shapes::Grid(14, 14), shapes::Sphere(7), shapes::Torus(14), shapes::OpenCylinder(24), shapes::Cube(6),
        shapes::MoebiusStrip(30), shapes::NonManifoldFin(6), shapes::BowTie(6), shapes::Plush(32)}) {
    const TestSurface surface(mesh);
    for (int trial = 0; trial < 4; ++trial) {
      // Charts by the nearest of some random faces, with a ragged edge.
      std::vector<Eigen::Vector3d> centres;
      for (int k = 0; k < 3 + 4 * trial; ++k)
        centres.push_back(
            surface->Centroid(static_cast<int>(random() % static_cast<unsigned>(surface->FaceCount()))));
      std::uniform_real_distribution<double> jitter(0, 0.12);
      ChartIds ids;
      for (int f = 0; f < surface->FaceCount(); ++f) {
        double least = 1e300;
        int best = 0;
        for (size_t k = 0; k < centres.size(); ++k) {
          const double d = (surface->Centroid(f) - centres[k]).norm() + jitter(random);
          if (d < least) {
            least = d;
            best = static_cast<int>(k);
          }
        }
        ids.push_back(best);
      }
      SplitAndCompact(*surface, ids);
      Params params;
      params.max_fitting_error = trial % 2 ? 4 : 0.2;
      const ChartIds straight = Straightened(surface, ids, params);
      EXPECT_EQ(ChartCount(straight), ChartCount(ids));
      EXPECT_TRUE(test::ChartsAreWhole(*surface, straight));
      EXPECT_EQ(std::count(straight.begin(), straight.end(), kUnassigned), 0);
      EXPECT_LE(BorderLength(surface, straight), BorderLength(surface, ids) * (1 + 1e-12));
    }
  }
}

TEST(StraightenShortestPath, ShortensSegmentedModels) {
  const TestSurface surface(shapes::Plush(32));
  Params params;
  params.chart_count = 12;
  Progress progress;
  ChartIds ids = Lloyd<SurfaceMesh>(*surface, params, progress).Run().ids;
  HoleFiller<SurfaceMesh>(*surface, params, progress).Run(ids);
  EXPECT_LT(BorderLength(surface, Straightened(surface, ids)), 0.995 * BorderLength(surface, ids));
}

// "Without increasing the fitting error": a crease between two planes is where the border stays.
TEST(StraightenShortestPath, BorderStaysOnACrease) {
  SurfaceData mesh = shapes::Grid(16, 16);
  // The planes left and right of x = 1/2 meet at a right angle.
  for (auto& p : mesh.vertices)
    if (p[0] > 0.5) p = {0.5, p[1], p[0] - 0.5};
  const TestSurface surface(mesh);
  const ChartIds ids = surface.Paint([](const auto& p) { return p[2] > 1e-9 ? 1 : 0; });
  EXPECT_EQ(Straightened(surface, ids), ids);
}

TEST(StraightenShortestPath, ChartWithinAChart) {
  const TestSurface surface(shapes::Grid(20, 20));
  const ChartIds ids = surface.Paint([](const auto& p) {
    const double angle = std::atan2(p[1] - 0.5, p[0] - 0.5);
    return std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.22 + 0.04 * std::sin(9 * angle) ? 1 : 0;
  });
  ASSERT_TRUE(test::ChartsAreWhole(*surface, ids));
  const ChartIds straight = Straightened(surface, ids);
  EXPECT_EQ(ChartCount(straight), 2) << "the inner chart is not swallowed";
  EXPECT_LT(BorderLength(surface, straight), BorderLength(surface, ids));
  EXPECT_GT(surface.AreaOf(straight, 1), 0.2 * surface.AreaOf(ids, 1));
}

TEST(StraightenShortestPath, OneChart) {
  const TestSurface surface(shapes::Sphere(4));
  EXPECT_EQ(Straightened(surface, ChartIds(surface->FaceCount(), 0)), ChartIds(surface->FaceCount(), 0));
}

}  // namespace
}  // namespace dcharts
