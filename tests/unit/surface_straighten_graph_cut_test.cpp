// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/straighten_graph_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/pi.h"
#include "surface/fill.h"
#include "surface/lloyd.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

ChartIds Straightened(const TestSurface& surface, ChartIds ids, const BorderCutOptions& options = {}) {
  Progress progress;
  GraphCutStraightener<SurfaceMesh>(*surface, options, progress).Run(ids);
  return ids;
}

// In input units.
double BorderLength(const TestSurface& surface, const ChartIds& ids) {
  return SeamLength(*surface, ChartBorders(*surface, ids)) / surface.Scale();
}

int EulerOf(const TestSurface& surface, const ChartIds& ids, int chart) {
  return ChartTopology<SurfaceMesh>(*surface).EulerPart(FacesOfCharts(ids)[chart], chart, ids);
}

// Charts by the nearest of some random faces, with a ragged edge `jitter` wide.
ChartIds RandomCharts(const TestSurface& surface, int count, double jitter, std::mt19937& random) {
  std::vector<Eigen::Vector3d> centres;
  for (int k = 0; k < count; ++k)
    centres.push_back(
        surface->Centroid(static_cast<int>(random() % static_cast<unsigned>(surface->FaceCount()))));
  std::uniform_real_distribution<double> noise(0, jitter);
  ChartIds ids;
  for (int f = 0; f < surface->FaceCount(); ++f) {
    std::vector<double> distance;
    for (const auto& c : centres) distance.push_back((surface->Centroid(f) - c).norm() + noise(random));
    ids.push_back(static_cast<int>(std::min_element(distance.begin(), distance.end()) - distance.begin()));
  }
  SplitAndCompact(*surface, ids);
  return ids;
}

TEST(StraightenGraphCut, RaggedBorderOnAPlaneBecomesTheLine) {
  const int n = 20;
  const TestSurface surface(shapes::Grid(n, n));
  // Teeth of one or two quads on both sides of the middle.
  const ChartIds ragged = surface.Paint([&](const auto& p) {
    const int shift = (static_cast<int>(p[1] * n) * 7 % 5) - 2;
    return static_cast<int>(p[0] * n) < n / 2 + shift ? 0 : 1;
  });
  ASSERT_GT(BorderLength(surface, ragged), 1.5);
  BorderCutOptions wide;
  wide.band = 0.2;
  EXPECT_EQ(Straightened(surface, ragged, wide),
            surface.Paint([](const auto& p) { return p[0] < 0.5 ? 0 : 1; }));
  // The default band is narrower than the longest teeth.
  EXPECT_LT(BorderLength(surface, Straightened(surface, ragged)), 1.2);
}

TEST(StraightenGraphCut, StraightBorderStays) {
  const TestSurface surface(shapes::Grid(12, 12));
  const ChartIds ids = surface.Paint([](const auto& p) { return p[0] < 0.5 ? 0 : 1; });
  EXPECT_EQ(Straightened(surface, ids), ids);
}

// Between the two long sides of a strip the shortest border is square to them, wherever it ends.
TEST(StraightenGraphCut, BorderIsFreeToMoveAlongTheBorderOfTheMesh) {
  SurfaceData strip = shapes::Grid(60, 10);
  for (auto& p : strip.vertices) p[1] /= 6;
  const TestSurface surface(strip);
  const ChartIds slanted = surface.Paint([](const auto& p) { return p[0] < 0.45 + 0.6 * p[1] ? 0 : 1; });
  ASSERT_GT(BorderLength(surface, slanted), 1.2 / 6);
  BorderCutOptions options;
  options.band = 0.2;
  EXPECT_NEAR(BorderLength(surface, Straightened(surface, slanted, options)), 1.0 / 6, 1e-9);
}

TEST(StraightenGraphCut, RaggedCircleAroundACylinderBecomesARing) {
  const int n = 24, m = 16;
  SurfaceData tube;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i < n; ++i)
      tube.vertices.push_back({std::cos(2 * kPi * i / n) / 2, std::sin(2 * kPi * i / n) / 2, 1.5 * j / m});
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
  const double ring = n * 2 * std::sin(kPi / n) / 2;
  ASSERT_GT(BorderLength(surface, ragged), 1.3 * ring);
  const ChartIds straight = Straightened(surface, ragged);
  EXPECT_NEAR(BorderLength(surface, straight), ring, 1e-9);
  EXPECT_TRUE(test::ChartsAreWhole(*surface, straight));
}

TEST(StraightenGraphCut, BordersOfACubeSnapOntoItsCreases) {
  std::mt19937 random(5);
  for (int n : {6, 10}) {
    const TestSurface cube(shapes::Cube(n));
    const ChartIds sides = cube.Paint([](const auto& p) { return test::CubeSide(p, {0.5, 0.5, 0.5}, 0.5); });
    ChartIds jittered = sides;  // some faces at the creases have gone to the other side, none side by side
    for (int h = 0; h < cube->HalfEdgeCount(); ++h) {
      bool alone = true;
      for (int k = 3 * (h / 3); k < 3 * (h / 3) + 3; ++k)
        alone = alone && jittered[cube->Neighbour(k)] == sides[cube->Neighbour(k)];
      if (alone && sides[cube->Neighbour(h)] != sides[h / 3] && random() % 6 == 0)
        jittered[h / 3] = sides[cube->Neighbour(h)];
    }
    ASSERT_GT(BorderLength(cube, jittered), BorderLength(cube, sides));
    ASSERT_TRUE(test::ChartsAreWhole(*cube, jittered)) << n;
    EXPECT_EQ(Straightened(cube, jittered), sides);
  }
}

// The fitting error alone does not tell where on the fold's rounding to cut; the crease does.
TEST(StraightenGraphCut, StraightBorderMovesOntoACreaseNearby) {
  SurfaceData mesh = shapes::Grid(32, 32);
  for (auto& p : mesh.vertices)
    if (p[0] > 0.5) p = {0.5, p[1], p[0] - 0.5};
  const TestSurface surface(mesh);
  const ChartIds beside = surface.Paint([](const auto& p) { return p[2] > 1.01 / 32 ? 1 : 0; });
  const ChartIds on_crease = surface.Paint([](const auto& p) { return p[2] > 1e-9 ? 1 : 0; });
  EXPECT_EQ(Straightened(surface, beside), on_crease);
  EXPECT_EQ(Straightened(surface, on_crease), on_crease);
}

TEST(StraightenGraphCut, NoChartVanishesFallsApartOrGetsAnotherLoop) {
  std::mt19937 random(14);
  for (const SurfaceData& mesh :
       {shapes::Grid(14, 14), shapes::Sphere(7), shapes::Torus(14), shapes::OpenCylinder(24), shapes::Cube(6),
        shapes::Cube(1), shapes::MoebiusStrip(30), shapes::NonManifoldFin(6), shapes::BowTie(6),
        shapes::TwoComponents(4), shapes::ClosedCone(24), shapes::Plush(32), shapes::CadPart(24)}) {
    const TestSurface surface(mesh);
    for (int trial = 0; trial < 6; ++trial) {
      const ChartIds ids = RandomCharts(surface, 2 + 5 * trial, trial % 2 ? 0.12 : 0.3, random);
      BorderCutOptions options;
      options.band = trial % 3 ? 0.05 : 0.5;
      options.length_weight = trial % 2 ? 0.003 : 0.1;
      const ChartIds straight = Straightened(surface, ids, options);
      ASSERT_EQ(ChartCount(straight), ChartCount(ids));
      EXPECT_EQ(std::count(straight.begin(), straight.end(), kUnassigned), 0);
      EXPECT_TRUE(test::ChartsAreWhole(*surface, straight));
      for (int c = 0; c < ChartCount(ids); ++c) {
        EXPECT_GE(EulerOf(surface, straight, c), EulerOf(surface, ids, c));
        EXPECT_GE(surface.AreaOf(straight, c), 0.5 * surface.AreaOf(ids, c) * (1 - 1e-9));
      }
    }
  }
}

// Closing the gap of a "C" would make the border shorter, and a ring.
TEST(StraightenGraphCut, ADiskStaysADisk) {
  const TestSurface surface(shapes::Grid(40, 40));
  const ChartIds ids = surface.Paint([](const auto& p) {
    const double x = p[0] - 0.5, y = p[1] - 0.5, r = std::hypot(x, y);
    return r > 0.15 && r < 0.35 && !(x > 0 && std::abs(y) < 0.03) ? 1 : 0;
  });
  ASSERT_EQ(EulerOf(surface, ids, 1), 1);
  BorderCutOptions options;
  options.band = 0.1;
  const ChartIds straight = Straightened(surface, ids, options);
  EXPECT_EQ(EulerOf(surface, straight, 1), 1);
  EXPECT_TRUE(test::ChartsAreWhole(*surface, straight));
  EXPECT_LT(BorderLength(surface, straight), BorderLength(surface, ids)) << "yet straightened elsewhere";
}

TEST(StraightenGraphCut, ChartWithinAChart) {
  const TestSurface surface(shapes::Grid(20, 20));
  const ChartIds ids = surface.Paint([](const auto& p) {
    const double angle = std::atan2(p[1] - 0.5, p[0] - 0.5);
    return std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.22 + 0.04 * std::sin(9 * angle) ? 1 : 0;
  });
  const ChartIds straight = Straightened(surface, ids);
  EXPECT_EQ(ChartCount(straight), 2);
  EXPECT_LT(BorderLength(surface, straight), 0.9 * BorderLength(surface, ids));
  EXPECT_GT(surface.AreaOf(straight, 1), 0.5 * surface.AreaOf(ids, 1));
}

TEST(StraightenGraphCut, OneChartAndGapsInTheIds) {
  const TestSurface sphere(shapes::Sphere(4));
  const ChartIds one(sphere->FaceCount(), 0);
  EXPECT_EQ(Straightened(sphere, one), one);
  const TestSurface surface(shapes::Grid(20, 20));
  const auto wave = [](const auto& p) { return p[0] < 0.5 + 0.05 * std::sin(40 * p[1]); };
  const ChartIds plain = Straightened(surface, surface.Paint([&](const auto& p) { return wave(p) ? 0 : 1; }));
  const ChartIds gaps = Straightened(surface, surface.Paint([&](const auto& p) { return wave(p) ? 2 : 5; }));
  for (int f = 0; f < surface->FaceCount(); ++f) EXPECT_EQ(gaps[f], plain[f] ? 5 : 2);
}

TEST(StraightenGraphCut, ShortensSegmentedModels) {
  for (const SurfaceData& mesh : {shapes::Plush(32), shapes::Torus(24)}) {
    const TestSurface surface(mesh);
    Params params;
    params.chart_count = 20;
    Progress progress;
    ChartIds ids = Lloyd<SurfaceMesh>(*surface, params, progress).Run().ids;
    HoleFiller<SurfaceMesh>(*surface, params, progress).Run(ids);
    const double before = BorderLength(surface, ids),
                 after = BorderLength(surface, Straightened(surface, ids));
    EXPECT_LT(after, 0.95 * before);
  }
}

// A crease weighs little at this angle; the fitting error draws the border to where the planes meet.
TEST(StraightenGraphCut, BorderMovesToWhereTwoPlanesMeet) {
  const int n = 40;
  SurfaceData mesh = shapes::Grid(3 * n, n);
  for (auto& p : mesh.vertices) {
    const double x = 3 * p[0], c = std::cos(35 * kPi / 180), s = std::sin(35 * kPi / 180);
    if (x > 2)
      p = {x, p[1], 0};
    else
      p = {2 - c * (2 - x), p[1], -s * (2 - x)};
  }
  const TestSurface surface(mesh);
  const ChartIds at_fold = surface.Paint([](const auto& p) { return p[0] > 2 ? 1 : 0; });
  for (double off : {-1.7 / n, 1.7 / n}) {
    const ChartIds beside = surface.Paint([&](const auto& p) { return p[0] > 2 + off ? 1 : 0; });
    ASSERT_NE(beside, at_fold);
    EXPECT_EQ(Straightened(surface, beside), at_fold);
  }
}

// A larger weight of length: shorter borders, never longer.
TEST(StraightenGraphCut, LengthWeightShortens) {
  std::mt19937 random(8);
  const TestSurface surface(shapes::Plush(40));
  const ChartIds ids = RandomCharts(surface, 12, 0.01, random);
  BorderCutOptions options;
  double last = 1e300;
  for (double weight : {0.0003, 0.003, 0.03}) {
    options.length_weight = weight;
    const double length = BorderLength(surface, Straightened(surface, ids, options));
    EXPECT_LT(length, last);
    last = length;
  }
}

TEST(StraightenGraphCut, TheNumberingOfFacesAndVerticesDoesNotMatter) {
  std::mt19937 random(31);
  for (SurfaceData mesh : {shapes::Plush(32), shapes::CadPart(24)}) {
    // No ties.
    std::uniform_real_distribution<double> jitter(-0.004, 0.004);
    for (auto& p : mesh.vertices)
      for (double& x : p) x += jitter(random);
    const TestSurface surface(mesh);
    const ChartIds ids = RandomCharts(surface, 15, 0.03, random);
    std::vector<int> face_at(mesh.faces.size()), vertex_at(mesh.vertices.size());
    std::iota(face_at.begin(), face_at.end(), 0);
    std::iota(vertex_at.begin(), vertex_at.end(), 0);
    std::shuffle(face_at.begin(), face_at.end(), random);
    std::shuffle(vertex_at.begin(), vertex_at.end(), random);
    SurfaceData shuffled = mesh;
    ChartIds shuffled_ids = ids;
    for (size_t v = 0; v < vertex_at.size(); ++v) shuffled.vertices[vertex_at[v]] = mesh.vertices[v];
    for (size_t f = 0; f < face_at.size(); ++f) {
      for (size_t i = 0; i < 3; ++i) shuffled.faces[face_at[f]][(i + f) % 3] = vertex_at[mesh.faces[f][i]];
      // Charts have other numbers too.
      shuffled_ids[face_at[f]] = ChartCount(ids) - 1 - ids[f];
    }
    const ChartIds straight = Straightened(surface, ids);
    const ChartIds other = Straightened(TestSurface(shuffled), shuffled_ids);
    for (size_t f = 0; f < face_at.size(); ++f)
      ASSERT_EQ(other[face_at[f]], ChartCount(ids) - 1 - straight[f]) << f;
    EXPECT_EQ(Straightened(surface, ids), straight) << "the same again";
  }
}

}  // namespace
}  // namespace dcharts
