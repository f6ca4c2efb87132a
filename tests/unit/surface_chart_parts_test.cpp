// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/chart_parts.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

ChartIds Halves(const TestSurface& surface) {
  return surface.Paint([](const auto& p) { return p[2] > 0 ? 1 : 0; });
}

TEST(ChartParts, ASmallSurfaceIsItsOwnFineCopy) {
  const TestSurface surface(shapes::Sphere(6));
  const ChartIds ids = Halves(surface);
  ChartParts<SurfaceMesh> parts(*surface, ids, false);
  const ChartPatch both = parts.FinePatch({0, 1});
  std::vector<int> all(ids.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(both.faces, all);
  for (size_t f = 0; f < ids.size(); ++f) {
    EXPECT_EQ(parts.PartOfFine(static_cast<int>(f)), ids[f]);
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(both.mesh.positions.row(both.mesh.triangles(static_cast<int>(f), i)).transpose(),
                surface->Position(static_cast<int>(f), i));
  }
}

TEST(ChartParts, ALargeSurfaceHasCopiesWithFewerFaces) {
  const TestSurface surface(shapes::Sphere(20));
  ASSERT_EQ(surface->FaceCount(), 8000);
  const ChartIds ids = Halves(surface);
  ChartParts<SurfaceMesh> parts(*surface, ids, false, 5000);
  const ChartPatch fine = parts.FinePatch({0, 1}), coarse = parts.CoarsePatch({0, 1}),
                   half = parts.FinePatch({1});
  EXPECT_LE(fine.faces.size(), 5000u);
  EXPECT_GT(fine.faces.size(), 4900u);
  EXPECT_LE(coarse.faces.size(), 3000u);
  for (int f : half.faces) EXPECT_EQ(parts.PartOfFine(f), 1);
  for (const ChartPatch& patch : {fine, coarse})
    EXPECT_NEAR(patch.Area(), surface->TotalArea(), 0.005 * surface->TotalArea());
  // Figures are those of the surface.
  double half_area = 0;
  for (size_t f = 0; f < ids.size(); ++f)
    if (ids[f] == 1) half_area += surface->Area(static_cast<int>(f));
  EXPECT_NEAR(parts.Area(1), half_area / surface->TotalArea(), 1e-12);
  EXPECT_DOUBLE_EQ(parts.Unit(), std::sqrt(surface->TotalArea()));
}

}  // namespace
}  // namespace dcharts
