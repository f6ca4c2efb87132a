// SPDX-License-Identifier: GPL-3.0-or-later
/// Charts too small or too narrow to work with go to a neighbour.
#include <gtest/gtest.h>

#include <array>

#include "pattern/surface/charts_for_pattern.h"
#include "shapes.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

// What is left of three charts: a square sheet of that side, in mm, with a strip a fortieth wide in its
// middle.
int ChartsLeft(double side, double tab_width) {
  const SurfaceData grid = shapes::Grid(40, 40);
  const TestSurface surface(grid);
  ChartIds ids = surface.Paint([](const std::array<double, 3>& p) {
    return p[0] < 0.5 ? 0 : p[0] < 0.525 ? 1 : 2;
  });
  SeamMask seams = ChartBorders(*surface, ids);
  Params params;
  params.material = PatternMaterial::kPaper;
  params.tab_width = tab_width;
  Progress progress;
  ChartsForPattern charts(*surface, params, side, MirroredHalves(), progress);
  charts.Flatten(ids, seams, KnownFlattenings());
  return ChartCount(ids);
}

TEST(PatternJoin, AStripNarrowerThanHalfATabGoesToANeighbour) {
  EXPECT_EQ(ChartsLeft(450, 30), 2);  // 11 mm wide, and large enough
  EXPECT_EQ(ChartsLeft(900, 30), 3);  // 22 mm
}

}  // namespace
}  // namespace dcharts
