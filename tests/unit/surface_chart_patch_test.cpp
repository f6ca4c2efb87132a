// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/chart_patch.h"

#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"
#include "thread_count.h"

namespace dcharts {
namespace {

using test::TestSurface;

// Charts in bands, one of which is left out.
void ExpectAllAsOneByOne(const SurfaceData& mesh) {
  const TestSurface surface(mesh);
  const ChartIds ids = surface.Paint([](const auto& p) { return static_cast<int>(10 * (p[0] + 10)) % 5; });
  std::vector<std::vector<int>> charts = FacesOfCharts(ids);
  charts.erase(charts.begin() + 1);
  SeamMask seams(surface->FaceCount(), 0);
  SetSeam(seams, 0);
  PatchExtractor<SurfaceMesh> extractor(*surface, seams);
  const std::vector<ChartPatch> all = extractor.ExtractAll(charts);
  ASSERT_EQ(all.size(), charts.size());
  for (size_t k = 0; k < charts.size(); ++k) {
    const ChartPatch patch = extractor.Extract(charts[k]);
    EXPECT_EQ(all[k].faces, charts[k]);
    EXPECT_EQ(all[k].opposite, patch.opposite);
    EXPECT_EQ(all[k].mesh.triangles, patch.mesh.triangles);
    EXPECT_EQ(all[k].mesh.positions, patch.mesh.positions);
  }
}

TEST(PatchExtractor, TakesSeveralChartsOutAsOneByOne) {
  for (int count : {1, 2}) {
    const test::Threads threads(count);
    ExpectAllAsOneByOne(shapes::Plush(32));
    ExpectAllAsOneByOne(shapes::Plush(90));  // on all threads
  }
}

}  // namespace
}  // namespace dcharts
