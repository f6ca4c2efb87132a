// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/denoised_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/pi.h"
#include "noisy.h"
#include "surface/crease_weight.h"
#include "surface/workspace.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::Noisy;
using test::TestSurface;
using Normals = std::vector<Eigen::Vector3d>;

class DenoisedSurface {
 public:
  explicit DenoisedSurface(const SurfaceData& data) : raw(data) {
    BuildSurface(data, mesh_);
    graph = std::make_unique<SurfaceGraph<SurfaceMesh>>(mesh_);
    noisy = DenoiseNormals(*graph);
  }
  TestSurface raw;
  std::unique_ptr<SurfaceGraph<SurfaceMesh>> graph;
  bool noisy;

 private:
  SurfaceMesh mesh_;
};

// Root of the mean square of the angles to `truth`, degrees.
double Error(const SurfaceGraph<SurfaceMesh>& surface, const Normals& truth) {
  double sum = 0;
  for (int f = 0; f < surface.FaceCount(); ++f) {
    const double angle = std::acos(std::clamp(surface.Normal(f).dot(truth[f]), -1.0, 1.0));
    sum += surface.Area(f) * angle * angle;
  }
  return std::sqrt(sum / surface.TotalArea()) * 180 / kPi;
}

Normals NormalsOf(const SurfaceData& mesh) {
  const TestSurface surface(mesh);
  Normals normals;
  for (int f = 0; f < surface->FaceCount(); ++f) normals.push_back(surface->Normal(f));
  return normals;
}

TEST(VertexNoise, IsMeasuredInEdgesWhateverTheShape) {
  for (const SurfaceData& mesh :
       {shapes::Grid(20, 20), shapes::Sphere(12), shapes::Torus(24), shapes::OpenCylinder(), shapes::Cube(16),
        shapes::CadPart(), shapes::Plush()})
    for (double share : {0.05, 0.1}) {
      const double measured = VertexNoise(*TestSurface(Noisy(mesh, share)));
      EXPECT_GT(measured, 0.8 * share);
      EXPECT_LT(measured, 1.6 * share) << "creases add to it";
    }
}

TEST(VertexNoise, IsNothingOfAFewVertices) {
  for (const SurfaceData& mesh : {shapes::Cube(1), shapes::Sphere(1), shapes::Grid(4, 4)})
    EXPECT_EQ(VertexNoise(*TestSurface(Noisy(mesh, 0.1))), 0);
}

TEST(DenoiseNormals, LeavesCleanShapesAsTheyAre) {
  std::vector<SurfaceData> meshes = {shapes::Sphere(4), shapes::Torus(8), shapes::CadPart(24),
                                     shapes::Plush(32)};
  for (const auto& shape : shapes::AllShapes()) meshes.push_back(shape.mesh);
  for (const SurfaceData& mesh : meshes) {
    const DenoisedSurface surface(mesh);
    EXPECT_FALSE(surface.noisy);
    for (int f = 0; f < surface.graph->FaceCount(); ++f)
      ASSERT_EQ(surface.graph->Normal(f), surface.raw->Normal(f));
  }
}

TEST(DenoiseNormals, KeepsTheCreasesOfANoisyCube) {
  const SurfaceData cube = shapes::Cube(16);
  const TestSurface clean(cube);
  for (double share : {0.05, 0.1}) {
    const DenoisedSurface surface(Noisy(cube, share));
    ASSERT_TRUE(surface.noisy);
    const std::vector<double> weights = CreaseWeights(*surface.graph);
    for (int h = 0; h < clean->HalfEdgeCount(); ++h) {
      const double before = DihedralAngle(*clean, h), after = DihedralAngle(*surface.graph, h);
      EXPECT_NEAR(after, before, (share > 0.07 ? 45 : 20) * kPi / 180);
      if (share < 0.07) {
        EXPECT_NEAR(weights[h], before > 1 ? 0.25 : 1, 1e-9);
      }
    }
    EXPECT_LT(Error(*surface.graph, NormalsOf(cube)), 0.3 * Error(*surface.raw, NormalsOf(cube)));
  }
}

TEST(DenoiseNormals, BringsRoundShapesNearerToTheirTrueNormals) {
  struct Case {
    SurfaceData mesh;
    std::function<Eigen::Vector3d(const std::array<double, 3>&)> truth;
  };
  const Case cases[] = {
      {shapes::OpenCylinder(), [](const auto& p) { return Eigen::Vector3d(p[0], p[1], 0); }},
      {shapes::Sphere(12), [](const auto& p) { return Eigen::Vector3d(p[0], p[1], p[2]); }},
      {shapes::OpenFrustum(), [](const auto& p) {
         const double r = std::hypot(p[0], p[1]);
         return Eigen::Vector3d(p[0], p[1], r / 2);  // its radius shrinks by half its height
       }}};
  for (const Case& one : cases) {
    Normals truth;
    for (const auto& face : one.mesh.faces) {
      std::array<double, 3> centroid{0, 0, 0};
      for (int v : face)
        for (size_t d = 0; d < 3; ++d) centroid[d] += one.mesh.vertices[v][d] / 3;
      truth.push_back(one.truth(centroid).normalized());
    }
    for (double share : {0.05, 0.1}) {
      const DenoisedSurface surface(Noisy(one.mesh, share));
      ASSERT_TRUE(surface.noisy);
      EXPECT_LT(Error(*surface.graph, truth), 0.4 * Error(*surface.raw, truth));
    }
  }
}

TEST(DenoiseNormals, TurnsWithTheSurface) {
  SurfaceData mesh = Noisy(shapes::CadPart(), 0.05);
  const DenoisedSurface before(mesh);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (auto& p : mesh.vertices) {
    const Eigen::Vector3d q = 3.7 * turn * Eigen::Vector3d(p[0], p[1], p[2]) + Eigen::Vector3d(5, -2, 9);
    p = {q.x(), q.y(), q.z()};
  }
  const DenoisedSurface after(mesh);
  ASSERT_TRUE(before.noisy && after.noisy);
  for (int f = 0; f < before.graph->FaceCount(); ++f)
    EXPECT_LT((turn * before.graph->Normal(f) - after.graph->Normal(f)).norm(), 1e-8);
}

TEST(DenoiseNormals, DoesNotHangOnTheNumbering) {
  const SurfaceData mesh = Noisy(shapes::CadPart(), 0.05);
  std::mt19937 random(4);
  std::vector<int> place(mesh.vertices.size()), order(mesh.faces.size());
  std::iota(place.begin(), place.end(), 0);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(place.begin(), place.end(), random);
  std::shuffle(order.begin(), order.end(), random);
  SurfaceData other = mesh;
  for (size_t v = 0; v < place.size(); ++v) other.vertices[place[v]] = mesh.vertices[v];
  for (size_t f = 0; f < order.size(); ++f)
    for (size_t i = 0; i < 3; ++i) other.faces[f][i] = place[mesh.faces[order[f]][(i + f) % 3]];
  const DenoisedSurface before(mesh), after(other);
  ASSERT_TRUE(before.noisy && after.noisy);
  for (size_t f = 0; f < order.size(); ++f)
    EXPECT_LT((before.graph->Normal(order[f]) - after.graph->Normal(static_cast<int>(f))).norm(), 1e-9);
}

TEST(DenoiseNormals, FacesWithoutAreaKeepTheirZero) {
  SurfaceData mesh = Noisy(shapes::Sphere(8), 0.05);
  // A second point where there is one: the face between them has no area.
  const auto [a, b, c] = mesh.faces[0];
  const int again = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(std::array<double, 3>(mesh.vertices[a]));
  mesh.faces[0] = {a, again, c};
  mesh.faces.push_back({again, b, c});
  const DenoisedSurface surface(mesh);
  ASSERT_TRUE(surface.noisy);
  EXPECT_TRUE(surface.graph->Normal(0).isZero(0));
  for (int f = 1; f < surface.graph->FaceCount(); ++f) EXPECT_NEAR(surface.graph->Normal(f).norm(), 1, 1e-12);
}

TEST(DenoiseNormals, IsDoneForTheStages) {
  const SurfaceData mesh = Noisy(shapes::CadPart(), 0.05);
  const DenoisedSurface surface(mesh);
  const Workspace work(mesh);
  for (int f = 0; f < surface.graph->FaceCount(); ++f) {
    EXPECT_EQ(work.Surface().Normal(f), surface.graph->Normal(f));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(work.Surface().Position(f, i), surface.raw->Position(f, i));
  }
}

}  // namespace
}  // namespace dcharts
