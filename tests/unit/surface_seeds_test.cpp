// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

std::vector<int> SeedsOf(const std::vector<GrowingChart>& charts) {
  std::vector<int> seeds;
  for (const GrowingChart& c : charts) seeds.push_back(c.seed);
  return seeds;
}

TEST(Seeds, FirstIsAnExtremity) {
  // A cone's apex is farthest from its middle, a long prism's end too.
  const TestSurface surface(shapes::OpenCone(24));
  Seeds<SurfaceMesh> seeds(*surface);
  const int seed = seeds.FarthestPoints(1).front().seed;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int f = 0; f < surface->FaceCount(); ++f) centre += surface->Area(f) * surface->Centroid(f);
  for (int f = 0; f < surface->FaceCount(); ++f)
    EXPECT_LE((surface->Centroid(f) - centre).norm(), (surface->Centroid(seed) - centre).norm() + 1e-9);
}

TEST(Seeds, EachIsTheFarthestFromThoseBefore) {
  const TestSurface surface(shapes::Torus(12));
  Seeds<SurfaceMesh> seeds(*surface);
  const std::vector<int> found = SeedsOf(seeds.FarthestPoints(8));
  ASSERT_EQ(found.size(), 8u);
  DualDistance<SurfaceMesh> distance(*surface);
  for (size_t k = 1; k < found.size(); ++k) {
    distance.Run({found.begin(), found.begin() + static_cast<std::ptrdiff_t>(k)}, [](int) { return true; });
    for (int f = 0; f < surface->FaceCount(); ++f) ASSERT_LE(distance[f], distance[found[k]]) << k;
  }
}

TEST(Seeds, AllDifferentAndNoMoreThanFaces) {
  const TestSurface surface(shapes::Cube(1));
  Seeds<SurfaceMesh> seeds(*surface);
  for (int count : {1, 5, 12, 100}) {
    const std::vector<int> found = SeedsOf(seeds.FarthestPoints(count));
    EXPECT_EQ(found.size(), static_cast<size_t>(std::min(count, 12)));
    EXPECT_EQ(std::set<int>(found.begin(), found.end()).size(), found.size());
  }
}

TEST(Seeds, EveryComponentGetsOne) {
  const TestSurface surface(shapes::TwoComponents(3));
  Seeds<SurfaceMesh> seeds(*surface);
  const std::vector<int> found = SeedsOf(seeds.FarthestPoints(2));
  ChartIds component(surface->FaceCount(), 0);
  SplitAndCompact(*surface, component);
  EXPECT_NE(component[found[0]], component[found[1]]);
}

// An arbitrary face may make a chart wrap a limb.
TEST(Seeds, EveryComponentStartsAtAnExtremity) {
  const TestSurface surface(shapes::TwoComponents(3));
  Seeds<SurfaceMesh> seeds(*surface);
  const std::vector<int> found = SeedsOf(seeds.FarthestPoints(2));
  ChartIds component(surface->FaceCount(), 0);
  SplitAndCompact(*surface, component);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int f = 0; f < surface->FaceCount(); ++f) centre += surface->Area(f) * surface->Centroid(f);
  for (int seed : found)
    for (int f = 0; f < surface->FaceCount(); ++f)
      if (component[f] == component[seed]) {
        EXPECT_LE((surface->Centroid(f) - centre).norm(), (surface->Centroid(seed) - centre).norm() + 1e-9);
      }
}

TEST(Seeds, NoneOnAFaceWithoutArea) {
  SurfaceData mesh = shapes::Grid(4, 4);
  const int v = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back({50, 50, 0});
  mesh.vertices.push_back({60, 60, 0});
  mesh.vertices.push_back({70, 70, 0});
  mesh.faces.push_back({v, v + 1, v + 2});
  const TestSurface surface(mesh);
  Seeds<SurfaceMesh> seeds(*surface);
  for (int seed : SeedsOf(seeds.FarthestPoints(10))) EXPECT_GT(surface->Area(seed), 0);
}

TEST(Seeds, FirstProxyFitsItsSeed) {
  for (const SurfaceData& mesh : {shapes::Cube(4), shapes::OpenCylinder(20), shapes::Sphere(6)}) {
    const TestSurface surface(mesh);
    Seeds<SurfaceMesh> seeds(*surface);
    for (int seed = 0; seed < surface->FaceCount(); ++seed) {
      const ConeProxy proxy = seeds.ProxyAtSeed(seed);
      const double error = FittingError(proxy, surface->Normal(seed));
      // No worse than that of any of the three rings.
      for (int i = 0; i < 3; ++i) {
        NormalMoments moments;
        const int v = surface->Vertex(3 * seed + i);
        for (const int* h = surface->RingBegin(v); h != surface->RingEnd(v); ++h)
          moments.Add(surface->Area(*h / 3), surface->Normal(*h / 3));
        ASSERT_LE(error, FittingError(FitCone(moments), surface->Normal(seed)) + 1e-15);
      }
    }
  }
}

TEST(Seeds, RefitFindsTheMiddleOfAPlane) {
  const TestSurface surface(shapes::Grid(9, 9));
  std::vector<int> faces(surface->FaceCount());
  std::iota(faces.begin(), faces.end(), 0);
  const GrowingChart chart = Seeds<SurfaceMesh>(*surface).Refit(faces, Params());
  EXPECT_NEAR(std::abs(chart.proxy.axis.z()), 1, 1e-9);
  // All errors are 0: the most central of all faces.
  EXPECT_LT(surface->Centroid(chart.seed).norm(), 1.0 / 9);
}

TEST(Seeds, RefitTakesTheMostCentralOfTheBestFitting) {
  const TestSurface surface(shapes::SphericalCap(8, 1.2));
  std::vector<int> faces(surface->FaceCount());
  std::iota(faces.begin(), faces.end(), 0);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int f : faces) centre += surface->Area(f) * surface->Centroid(f);
  centre /= surface->TotalArea();
  double last = 1e300;
  for (int k : {1, 10, 60, 384}) {
    Params params;
    params.seed_candidates = k;
    params.seed_percent = 0;
    const GrowingChart chart = Seeds<SurfaceMesh>(*surface).Refit(faces, params);
    const double error = FittingError(chart.proxy, surface->Normal(chart.seed));
    const auto better = std::count_if(faces.begin(), faces.end(), [&](int f) {
      return FittingError(chart.proxy, surface->Normal(f)) < error - 1e-12;
    });
    EXPECT_LT(better, k) << "the seed is one of the k best";
    const double distance = (surface->Centroid(chart.seed) - centre).norm();
    EXPECT_LE(distance, last + 1e-12) << "more candidates, none farther from the centre";
    last = distance;
  }
}

TEST(Seeds, PercentAndCountTheLargerCounts) {
  const TestSurface surface(shapes::SphericalCap(8, 1.2));
  std::vector<int> faces(surface->FaceCount());
  std::iota(faces.begin(), faces.end(), 0);
  auto seed = [&](int count, double percent) {
    Params params;
    params.seed_candidates = count;
    params.seed_percent = percent;
    return Seeds<SurfaceMesh>(*surface).Refit(faces, params).seed;
  };
  const int half = surface->FaceCount() / 2;
  EXPECT_EQ(seed(1, 50), seed(half, 0));
  EXPECT_EQ(seed(half, 1), seed(half, 0));
}

TEST(DualDistance, StepsOverCentroidsWithinTheAllowed) {
  const TestSurface surface(shapes::Grid(6, 1));
  DualDistance<SurfaceMesh> distance(*surface);
  distance.Run({0}, [](int) { return true; });
  EXPECT_EQ(distance[0], 0);
  for (int f = 1; f < surface->FaceCount(); ++f) {
    EXPECT_GE(distance[f], (surface->Centroid(f) - surface->Centroid(0)).norm() - 1e-12);
    // Bellman: no neighbour brings it nearer.
    for (int h = 3 * f; h < 3 * f + 3; ++h)
      if (surface->Neighbour(h) >= 0) {
        EXPECT_LE(distance[f], distance[surface->Neighbour(h)] + surface->Step(h) + 1e-12);
      }
  }
  const double end = distance[surface->FaceCount() - 1];
  distance.Run(
      {0}, [](int) { return true; }, end / 2);
  EXPECT_EQ(distance[surface->FaceCount() - 1], DualDistance<SurfaceMesh>::kFar);
  for (int f : distance.Reached()) EXPECT_LE(distance[f], end / 2);
  distance.Run({0}, [](int f) { return f != 4 && f != 5; });
  EXPECT_EQ(distance[surface->FaceCount() - 1], DualDistance<SurfaceMesh>::kFar) << "no way around";
}

}  // namespace
}  // namespace dcharts
