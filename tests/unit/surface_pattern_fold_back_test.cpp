// SPDX-License-Identifier: GPL-3.0-or-later
/// Paper folded and glued is the model again.
#include <gtest/gtest.h>

#include <string>

#include "dcharts.h"
#include "pattern/surface/base_mesh.h"
#include "pattern_fold_back.h"
#include "shapes.h"

namespace dcharts {
namespace {

struct Folded {
  const char* shape;
  double strain, hausdorff;  // at most
};

// For the test's name.
std::string ShapeOf(const testing::TestParamInfo<Folded>& test) { return test.param.shape; }

class PatternFoldedBack : public testing::TestWithParam<Folded> {};

PatternResult OfPaper(const SurfaceData& mesh) {
  Params params;
  params.material = PatternMaterial::kPaper;
  params.size = 240;
  params.print_texture = true;  // so that the pattern is made on these faces
  Progress progress;
  return MakePattern(mesh, params, progress);
}

void RecordFolded(const test::FoldedBack& folded) {
  testing::Test::RecordProperty("strain_percent", std::to_string(100 * folded.strain));
  testing::Test::RecordProperty("hausdorff_percent", std::to_string(100 * folded.hausdorff));
}

TEST_P(PatternFoldedBack, IsTheModelAgain) {
  const SurfaceData mesh = shapes::ShapeByName(GetParam().shape).mesh;
  const test::FoldedBack folded = test::FoldBack(mesh, OfPaper(mesh).pattern, mesh);
  RecordFolded(folded);
  EXPECT_LT(folded.strain, GetParam().strain);
  EXPECT_LT(folded.hausdorff, GetParam().hausdorff);
}

// The first three can be laid flat without any stretch, the others only nearly so.
INSTANTIATE_TEST_SUITE_P(Meshes, PatternFoldedBack,
                         testing::Values(Folded{"cube", 1e-6, 1e-5}, Folded{"closed_cylinder", 1e-6, 1e-5},
                                         Folded{"open_cone", 1e-5, 1e-4},
                                         Folded{"spherical_cap", 0.005, 0.005},
                                         Folded{"torus", 0.0035, 0.005}, Folded{"bishop", 0.002, 0.005},
                                         Folded{"cad_part", 0.0025, 0.005}, Folded{"plush", 0.003, 0.005}),
                         ShapeOf);

// Of models that are symmetric but for their triangles, patterns are made on an exactly symmetric mesh.
class PatternOfSymmetricMeshFoldedBack : public testing::TestWithParam<Folded> {};

TEST_P(PatternOfSymmetricMeshFoldedBack, IsTheUsersModelAgain) {
  const SurfaceData mesh = shapes::ShapeByName(GetParam().shape).mesh;
  BaseMesh base(mesh);
  base.MakeSymmetric(PatternMaterial::kPaper);
  ASSERT_TRUE(base.Halves().IsSymmetric());
  const test::FoldedBack folded = test::FoldBack(base.Mesh(), OfPaper(base.Mesh()).pattern, mesh);
  RecordFolded(folded);
  EXPECT_LT(folded.strain, GetParam().strain);
  EXPECT_LT(folded.hausdorff, GetParam().hausdorff);
}

INSTANTIATE_TEST_SUITE_P(Meshes, PatternOfSymmetricMeshFoldedBack,
                         testing::Values(Folded{"bishop", 0.002, 0.005}, Folded{"plush", 0.002, 0.005}),
                         ShapeOf);

// Paper that is too small must stretch, or be elsewhere: the folding can't hide it.
TEST(PatternFolding, TellsPiecesThatDoNotFit) {
  const SurfaceData mesh = shapes::ShapeByName("closed_cylinder").mesh;
  Pattern pattern = OfPaper(mesh).pattern;
  constexpr double kSmaller = 0.97;
  for (Piece& piece : pattern.pieces)
    for (Point2& p : piece.flat.vertices) p *= kSmaller;
  EXPECT_GT(test::FoldBack(mesh, pattern, mesh).strain, 0.005);
}

}  // namespace
}  // namespace dcharts
