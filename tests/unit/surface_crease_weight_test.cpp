// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/crease_weight.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/pi.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

// A square sheet folded along its middle by `angle` radians.
SurfaceData FoldedSheet(double angle) {
  SurfaceData mesh = shapes::Grid(12, 12);
  for (auto& p : mesh.vertices)
    if (p[0] > 0.5) p = {0.5 + (p[0] - 0.5) * std::cos(angle), p[1], (p[0] - 0.5) * std::sin(angle)};
  return mesh;
}

double LeastWeight(const SurfaceData& mesh) {
  const std::vector<double> weights = CreaseWeights(*TestSurface(mesh));
  return *std::min_element(weights.begin(), weights.end());
}

TEST(CreaseWeights, AreOneWhereTheSurfaceIsSmoothOrFlat) {
  // Of whatever coarseness: each edge of the icosahedron bends by 42 degrees.
  for (const SurfaceData& mesh : {shapes::Grid(8, 8), shapes::Sphere(1), shapes::Sphere(2), shapes::Sphere(9),
                                  shapes::Torus(12), shapes::OpenCylinder(24), shapes::SaddleRidge(8)})
    EXPECT_GT(LeastWeight(mesh), 0.85);
}

TEST(CreaseWeights, FallWithTheAngleOfAFold) {
  EXPECT_EQ(LeastWeight(FoldedSheet(20 * kPi / 180)), 1);
  const double half = LeastWeight(FoldedSheet(35 * kPi / 180));
  EXPECT_GT(half, 0.3);
  EXPECT_LT(half, 0.9);
  EXPECT_NEAR(LeastWeight(FoldedSheet(50 * kPi / 180)), 0.25, 1e-12);
  EXPECT_NEAR(LeastWeight(FoldedSheet(-90 * kPi / 180)), 0.25, 1e-12) << "convex or concave";
}

TEST(CreaseWeights, AreLeastOnAllEdgesOfACubeAndNowhereElse) {
  for (int n : {1, 2, 6}) {
    const TestSurface cube(shapes::Cube(n));
    const std::vector<double> weights = CreaseWeights(*cube);
    for (int h = 0; h < cube->HalfEdgeCount(); ++h) {
      const bool crease = DihedralAngle(*cube, h) > 1;
      EXPECT_NEAR(weights[h], crease ? 0.25 : 1, 1e-12) << n << " " << h;
    }
  }
}

TEST(CreaseWeights, NoiseMakesNoCreases) {
  std::mt19937 random(3);
  for (SurfaceData mesh : {shapes::Grid(30, 30), shapes::Sphere(14)}) {
    double edge = 0;
    {
      const TestSurface clean(mesh);
      for (int h = 0; h < clean->HalfEdgeCount(); ++h)
        edge += clean->Length(h) / clean.Scale() / clean->HalfEdgeCount();
    }
    std::normal_distribution<double> noise(0, 0.05 * edge);
    for (auto& p : mesh.vertices)
      for (double& x : p) x += noise(random);
    const std::vector<double> weights = CreaseWeights(*TestSurface(mesh));
    double mean = 0;
    for (double w : weights) mean += w / static_cast<double>(weights.size());
    EXPECT_GT(mean, 0.999);
    EXPECT_GT(*std::min_element(weights.begin(), weights.end()), 0.5);
  }
}

TEST(CreaseWeights, AreTheSameOnBothSidesOfAnEdge) {
  const TestSurface part(shapes::CadPart(24));
  const std::vector<double> weights = CreaseWeights(*part);
  for (int h = 0; h < part->HalfEdgeCount(); ++h)
    EXPECT_EQ(weights[h], weights[part->Opposite(h)]) << h;  // it has no border
}

}  // namespace
}  // namespace dcharts
