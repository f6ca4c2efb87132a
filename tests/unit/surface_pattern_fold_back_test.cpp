// SPDX-License-Identifier: GPL-3.0-or-later
/// Paper folded and glued is the model again.
#include <gtest/gtest.h>

#include "dcharts.h"
#include "pattern_fold_back.h"
#include "shapes.h"

namespace dcharts {
namespace {

struct Folded {
  const char* shape;
  double strain, hausdorff;  // at most
};

class PatternFoldedBack : public testing::TestWithParam<Folded> {};

TEST_P(PatternFoldedBack, IsTheModelAgain) {
  const SurfaceData mesh = shapes::ShapeByName(GetParam().shape).mesh;
  Params params;
  params.material = PatternMaterial::kPaper;
  params.size = 240;
  params.print_texture = true;  // so that the pattern is made on these faces
  Progress progress;
  const test::FoldedBack folded = test::FoldBack(mesh, MakePattern(mesh, params, progress).pattern);
  EXPECT_LT(folded.strain, GetParam().strain);
  EXPECT_LT(folded.hausdorff, GetParam().hausdorff);
}

// The first three can be laid flat without any stretch, the others only nearly so.
INSTANTIATE_TEST_SUITE_P(Meshes, PatternFoldedBack,
                         testing::Values(Folded{"cube", 1e-6, 1e-5}, Folded{"closed_cylinder", 1e-6, 1e-5},
                                         Folded{"open_cone", 1e-5, 1e-4},
                                         Folded{"spherical_cap", 0.01, 0.005}, Folded{"torus", 0.01, 0.005}),
                         [](const auto& test) { return std::string(test.param.shape); });

}  // namespace
}  // namespace dcharts
