// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh that a pattern is made on in place of the user's: coarser, or exactly symmetric.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "dcharts.h"
#include "pattern/surface/base_mesh.h"
#include "pattern/surface/chart_images.h"
#include "pattern/surface/coarse_mesh.h"
#include "pattern/surface/data_coordinates.h"
#include "pattern/surface/face_tree.h"
#include "pattern/surface/mirror_plane.h"
#include "pattern/surface/same_shape.h"
#include "shapes.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using Eigen::Vector3d;
using test::TestSurface;

// A flap on one side: part of the surface pushed out.
SurfaceData WithPocket(SurfaceData mesh, double height) {
  for (auto& v : mesh.vertices)
    if (std::hypot(v[0] - 0.3, v[1] + 0.3) < 0.2 && v[2] > 0) v[2] += height;
  return mesh;
}

TEST(PatternFaceTree, FindsTheNearestFace) {
  const SurfaceData torus = shapes::Torus(12);
  const FaceTree tree(torus);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.6, 1.6);
  for (int k = 0; k < 50; ++k) {
    const Vector3d p(place(random), place(random), place(random));
    // Against many points of each face.
    double nearest = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 12;
    for (const auto& [a, b, c] : torus.faces)
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j) {
          const Vector3d q = (PositionOf(torus, a) * i + PositionOf(torus, b) * j +
                              PositionOf(torus, c) * (kSteps - i - j)) /
                             kSteps;
          nearest = std::min(nearest, (q - p).norm());
        }
    EXPECT_LE(tree.Find(p).distance, nearest + 1e-12);
    EXPECT_GE(tree.Find(p).distance, nearest - 0.03);
  }
}

TEST(PatternFaceTree, TellsTheSidesOfAThinSheetApart) {
  SurfaceData sheet = shapes::Grid(4, 4);
  const int front = static_cast<int>(sheet.faces.size());
  for (int f = 0; f < front; ++f) {
    const auto [a, b, c] = sheet.faces[f];
    sheet.faces.push_back({a, c, b});
  }
  const FaceTree tree(sheet);
  EXPECT_LT(tree.FindFacing({0.4, 0.7, 0}, {0, 0, 1}).face, front);
  EXPECT_GE(tree.FindFacing({0.4, 0.7, 0}, {0, 0, -1}).face, front);
}

TEST(PatternBaseMesh, AFineMeshIsCoarsenedToTheSameShape) {
  const SurfaceData sphere = shapes::Sphere(40);
  const TestSurface surface(sphere);
  const auto coarse = CoarseMesh(sphere, *surface, PatternMaterial::kPaper);
  ASSERT_TRUE(coarse.has_value());
  EXPECT_LT(coarse->faces.size(), sphere.faces.size() / 2);
  EXPECT_TRUE(AreSameShape(sphere, *coarse, {0.01, 0.003}));
  EXPECT_FALSE(AreSameShape(sphere, WithPocket(*coarse, 0.1), {0.01, 1}));
  EXPECT_FALSE(AreSameShape(WithPocket(sphere, 0.1), *coarse, {0.01, 1}));
}

TEST(PatternBaseMesh, OthersAreNotCoarsened) {
  const SurfaceData few = shapes::Sphere(8);
  EXPECT_FALSE(CoarseMesh(few, *TestSurface(few), PatternMaterial::kFabric).has_value());
  const SurfaceData fin = shapes::NonManifoldFin(64);
  ASSERT_GT(fin.faces.size(), 20000u);
  EXPECT_FALSE(CoarseMesh(fin, *TestSurface(fin), PatternMaterial::kFabric).has_value());
}

TEST(PatternBaseMesh, APatternOfAFineMeshKnowsTheUsersFaces) {
  const SurfaceData sphere = shapes::Sphere(32);
  Params params;
  params.size = 300;
  Progress progress;
  const Pattern pattern = MakePattern(sphere, params, progress).pattern;
  ASSERT_EQ(pattern.piece_of_face.size(), sphere.faces.size());
  std::vector<double> area(pattern.pieces.size(), 0);
  for (size_t f = 0; f < sphere.faces.size(); ++f) {
    ASSERT_GE(pattern.piece_of_face[f], 0);
    const auto& [a, b, c] = sphere.faces[f];
    area[pattern.piece_of_face[f]] += (PositionOf(sphere, b) - PositionOf(sphere, a))
                                          .cross(PositionOf(sphere, c) - PositionOf(sphere, a))
                                          .norm() /
                                      2 * pattern.scale * pattern.scale;
  }
  for (const Piece& piece : pattern.pieces) {
    EXPECT_NEAR(area[piece.id], piece.model_area, 0.05 * piece.model_area + 100);
    for (int f : piece.flat.face) EXPECT_LT(f, static_cast<int>(sphere.faces.size()));
  }
}

TEST(PatternBaseMesh, ASymmetricModelBecomesExactlySo) {
  for (const char* name : {"plush", "cube", "torus"}) {
    const SurfaceData model = shapes::ShapeByName(name).mesh;
    BaseMesh base(model);
    base.MakeSymmetric(PatternMaterial::kFabric);
    ASSERT_TRUE(base.Halves().IsSymmetric()) << name;
    EXPECT_TRUE(AreSameShape(model, base.Mesh(), {0.006 * LongestSide(model), 0.001})) << name;
    const auto mirror = FindMirrorPlane(base.Surface());
    ASSERT_TRUE(mirror.has_value()) << name;
    for (int h = 0; h < base.Surface().HalfEdgeCount(); ++h) {
      const int image = base.Halves().ImageOfEdge(h);
      EXPECT_LT((mirror->Mirrored(base.Surface().Position(base.Surface().Vertex(h))) -
                 base.Surface().Position(base.Surface().Vertex(Next(image))))
                    .norm(),
                1e-9);
    }
  }
}

// Its groove is as narrow as an edge, and its triangles are no mirror images.
TEST(PatternBaseMesh, ABishopBecomesSymmetricOfEitherMaterial) {
  const SurfaceData bishop = shapes::Bishop();
  for (const PatternMaterial material : {PatternMaterial::kFabric, PatternMaterial::kPaper}) {
    BaseMesh base(bishop);
    base.MakeSymmetric(material);
    EXPECT_TRUE(base.Halves().IsSymmetric());
  }
}

// At an end of its slit the halves differ by .82 % of the size.
TEST(PatternBaseMesh, WhereHalvesDifferBothGiveWay) {
  const SurfaceData bishop = shapes::Bishop();
  BaseMesh base(bishop);
  base.MakeSymmetric(PatternMaterial::kPaper);
  ASSERT_TRUE(base.Halves().IsSymmetric());
  EXPECT_TRUE(AreSameShape(bishop, base.Mesh(), {0.0045 * LongestSide(bishop), 0.002}));
}

TEST(PatternBaseMesh, PaperKeepsNearerToTheModelThanFabric) {
  for (const double height : {0.0, 1e-3, 0.02}) {
    SurfaceData model = shapes::Torus(16);  // 2.8 wide, edges of 0.15
    for (auto& v : model.vertices)
      if (v[0] > 1 && v[1] > 0 && v[2] > 0.1) v[2] += height;
    ASSERT_TRUE(FindMirrorPlane(*TestSurface(model)).has_value());
    BaseMesh paper(model), fabric(model);
    paper.MakeSymmetric(PatternMaterial::kPaper);
    fabric.MakeSymmetric(PatternMaterial::kFabric);
    EXPECT_EQ(paper.Halves().IsSymmetric(), height < 0.01) << height;
    if (height < 0.01) {
      EXPECT_TRUE(fabric.Halves().IsSymmetric()) << height;
    }
  }
}

TEST(PatternBaseMesh, AFeatureOnOneSideIsKept) {
  for (const double height : {0.02, 0.05, 0.1}) {
    const SurfaceData model = WithPocket(shapes::Plush(40), height);
    for (const PatternMaterial material : {PatternMaterial::kFabric, PatternMaterial::kPaper}) {
      BaseMesh base(model);
      base.MakeSymmetric(material);
      EXPECT_FALSE(base.Halves().IsSymmetric()) << height;
      EXPECT_EQ(&base.Mesh(), &model);
    }
  }
}

TEST(PatternChartImages, FollowersAreCopies) {
  const SurfaceData cube = shapes::Cube(4);
  BaseMesh base(cube);
  base.MakeSymmetric(PatternMaterial::kFabric);
  const int half = base.Halves().half;
  ASSERT_GT(half, 4);
  // Both halves, then the first one is parted and gets a seam and a map.
  ChartIds ids(2 * half, 0);
  for (int f = half; f < 2 * half; ++f) ids[f] = 1;
  ChartImages images(base.Halves());
  images.Pair(ids);
  EXPECT_EQ(images.ImageChart(ids, 0), 1);
  EXPECT_TRUE(images.Follows(half) && images.IsFollowed(0) && !images.Follows(0));
  ids[2] = ids[3] = 2;
  SeamMask seams(2 * half, 0);
  seams[1] = 1;  // its edge from the first corner to the second
  std::vector<FaceUv> uv(2 * half, FaceUv{});
  uv[1] = {1, 2, 3, 4, 5, 6};
  images.Copy(ids, seams, uv);
  EXPECT_EQ(ids[half + 2], ids[half + 3]);
  EXPECT_NE(ids[half + 2], ids[half]);
  EXPECT_NE(ids[half], ids[0]);
  EXPECT_EQ(seams[half + 1], 4);
  EXPECT_EQ(uv[half + 1], (FaceUv{-1, 2, -5, 6, -3, 4}));
  EXPECT_EQ(images.ImageChart(ChartIds(2 * half, 0), 0), 0);
  ids.assign(2 * half, 0);
  ids[1] = 1;
  EXPECT_EQ(images.ImageChart(ids, 1), -1);
}

}  // namespace
}  // namespace dcharts
