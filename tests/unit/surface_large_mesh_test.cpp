// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of more than 100,000 faces: charts are found, and borders moved, on coarser copies.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "dcharts.h"
#include "run_stages.h"
#include "surface/face_order.h"
#include "surface/refine_on_copy.h"
#include "surface_fixture.h"
#include "thread_count.h"

namespace dcharts {
namespace {

const SurfaceData& LargePlush() {
  static const SurfaceData mesh = shapes::Plush(150);
  return mesh;
}

TEST(LargeMesh, StageByStageGivesTheSoundAtlasOfOneShot) {
  const SurfaceData& mesh = LargePlush();
  ASSERT_GT(mesh.faces.size(), 100000u);
  const Params params;
  Progress progress;
  const SurfaceChange once = TextureAtlas(mesh, params, progress);
  EXPECT_EQ(test::WrongInAtlas(mesh, once, false), "");
  EXPECT_LE(*once.report.charts, 8);
  EXPECT_LE(*once.report.linf_stretch, 2);
  const SurfaceChange stages = test::RunAll(mesh, params, test::Kept::kFile, test::kAllStages);
  EXPECT_EQ(stages.chart_ids, once.chart_ids);
  EXPECT_TRUE(stages.wedge_texcoords == once.wedge_texcoords);
}

TEST(LargeMesh, WorkThatIsDoneAheadChangesNothing) {
  Progress progress;
  std::vector<SurfaceChange> results;
  for (int count : {1, 3}) {
    const test::Threads threads(count);
    results.push_back(TextureAtlas(LargePlush(), Params(), progress));
  }
  EXPECT_EQ(results[1].chart_ids, results[0].chart_ids);
  EXPECT_TRUE(results[1].wedge_texcoords == results[0].wedge_texcoords);
}

TEST(FaceOrder, OfALargeMeshIsAPermutationWithNeighboursNearEachOther) {
  const SurfaceData& mesh = LargePlush();
  std::vector<int> faces(mesh.faces.size());
  for (size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<int>((7919 * f) % faces.size());
  const std::vector<int> shuffled = faces;
  SortForMemory(mesh, faces);
  const auto mean_step = [&](const std::vector<int>& order) {
    double sum = 0;
    for (size_t k = 1; k < order.size(); ++k)
      sum += test::Norm(
          test::Minus(mesh.vertices[mesh.faces[order[k]][0]], mesh.vertices[mesh.faces[order[k - 1]][0]]));
    return sum / static_cast<double>(order.size());
  };
  EXPECT_LT(10 * mean_step(faces), mean_step(shuffled));
  std::vector<int> sorted = faces;
  std::sort(sorted.begin(), sorted.end());
  for (size_t f = 0; f < sorted.size(); ++f) ASSERT_EQ(sorted[f], static_cast<int>(f));
}

TEST(FaceOrder, OfASmallMeshStays) {
  const SurfaceData mesh = shapes::Grid(4, 4);
  std::vector<int> faces{3, 1, 2};
  SortForMemory(mesh, faces);
  EXPECT_EQ(faces, (std::vector<int>{3, 1, 2}));
}

TEST(AbsorbIslands, GivesAllButTheLargestPieceToNeighbours) {
  const test::TestSurface surface(shapes::Grid(20, 20));
  // Two halves, and in the left one a small square of the right one's id.
  const SurfaceData& input = surface.Input();
  double low = 1e300, high = -1e300;
  for (const auto& v : input.vertices) {
    low = std::min(low, v[0]);
    high = std::max(high, v[0]);
  }
  const double width = high - low;
  const auto half = [&](const std::array<double, 3>& p) { return p[0] > low + width / 2 ? 1 : 0; };
  ChartIds ids = surface.Paint([&](const std::array<double, 3>& p) {
    return p[0] < low + 0.2 * width ? (p[0] > low + 0.1 * width ? 1 : 0) : half(p);
  });
  const ChartIds halves = surface.Paint(half);
  ASSERT_NE(ids, halves);
  AbsorbIslands(*surface, ids);
  EXPECT_EQ(ids, halves);
}

}  // namespace
}  // namespace dcharts
