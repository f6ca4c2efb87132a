// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/refine_borders.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/pi.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

ChartIds Refined(const TestSurface& surface, ChartIds ids, const Params& params = {},
                 const KnownTrials& known = {}) {
  Progress progress;
  BorderRefiner<SurfaceMesh>(*surface, params, progress).Run(known, ids);
  return ids;
}

double Seams(const TestSurface& surface, const ChartIds& ids) {
  return SeamLength(*surface, ChartBorders(*surface, ids));
}

double WorstStretch(const TestSurface& surface, const ChartIds& ids) {
  const SeamMask none(surface->FaceCount(), 0);
  double worst = 0;
  for (int c = 0; c < ChartCount(ids); ++c) {
    double cut = 0;
    const TrialFlattening flat = TrialFlatten(Opened(surface.Patch(ids, none, c), cut).mesh);
    EXPECT_TRUE(flat.ok);
    worst = std::max(worst, flat.l2_stretch);
  }
  return worst;
}

TEST(RefineBorders, ChartsNotInOnePieceAreFound) {
  const TestSurface surface(shapes::Grid(6, 6));
  // 0 has two pieces, 3 no face.
  const ChartIds ids = surface.Paint([](const auto& p) {
    return p[0] < 1.0 / 3 ? 0 : p[0] < 2.0 / 3 ? 1 : p[1] < 0.5 ? 0 : 2;
  });
  EXPECT_EQ(ChartsNotInOnePiece(*surface, ids, 4), (std::vector<bool>{true, false, false, true}));
}

TEST(RefineBorders, ARaggedBorderOnAPlaneBecomesShort) {
  const int n = 20;
  const TestSurface surface(shapes::Grid(n, n));
  const ChartIds ragged = surface.Paint([&](const auto& p) {
    const int shift = (static_cast<int>(p[1] * n) * 7 % 5) - 2;
    return static_cast<int>(p[0] * n) < n / 2 + shift ? 0 : 1;
  });
  ASSERT_GT(Seams(surface, ragged), 1.5);
  EXPECT_LT(Seams(surface, Refined(surface, ragged)), 1.2);
}

TEST(RefineBorders, KnownTrialsAreTaken) {
  const TestSurface surface(shapes::Grid(20, 20));
  const ChartIds ragged = surface.Paint([](const auto& p) { return p[0] < 0.4 + 0.2 * p[1] ? 0 : 1; });
  const SeamMask none(surface->FaceCount(), 0);
  KnownTrials right, wrong;
  for (int c : {0, 1}) {
    const ChartPatch patch = surface.Patch(ragged, none, c);
    TrialFlattening flat = TrialFlatten(patch.mesh);
    right.Add(patch.faces, flat);
    flat.l2_stretch = 2;
    wrong.Add(patch.faces, flat);
  }
  const ChartIds refined = Refined(surface, ragged);
  EXPECT_NE(refined, ragged);
  EXPECT_EQ(Refined(surface, ragged, {}, right), refined);
  EXPECT_EQ(Refined(surface, ragged, {}, wrong), ragged) << "charts above max_stretch keep their borders";
}

// A cube's sides cut off beside the crease: the seam finds the crease.
TEST(RefineBorders, SeamsGoToCreases) {
  const int n = 16;
  const TestSurface surface(shapes::Cube(n));
  const ChartIds sides = surface.Paint([](const auto& p) { return test::CubeSide(p, {0.5, 0.5, 0.5}, 0.5); });
  int up = 0;
  for (int f = 0; f < surface->FaceCount(); ++f)
    if (surface->Normal(f)[2] > 0.9) up = sides[f];
  // The top's chart comes down one row on all sides.
  const ChartIds low = [&] {
    ChartIds ids = surface.Paint([&](const auto& p) {
      return p[2] > 1 - 1.0 / n ? -1 : test::CubeSide(p, {0.5, 0.5, 0.5}, 0.5);
    });
    for (int& id : ids)
      if (id < 0) id = up;
    return ids;
  }();
  ASSERT_NE(low, sides);
  EXPECT_EQ(Refined(surface, low), sides);
}

TEST(RefineBorders, OfASphereSeamsGetShorterAndChartsNoWorseThanAllowed) {
  const TestSurface surface(shapes::Sphere(12));
  std::mt19937 random(3);
  std::vector<Eigen::Vector3d> centres;
  for (int k = 0; k < 8; ++k)
    centres.push_back(surface->Centroid(static_cast<int>(random() % surface->FaceCount())));
  std::uniform_real_distribution<double> noise(0, 0.05);
  ChartIds ids;
  for (int f = 0; f < surface->FaceCount(); ++f) {
    std::vector<double> d;
    for (const auto& c : centres) d.push_back((surface->Centroid(f) - c).norm() + noise(random));
    ids.push_back(static_cast<int>(std::min_element(d.begin(), d.end()) - d.begin()));
  }
  SplitAndCompact(*surface, ids);
  Params params;
  params.max_stretch = 1.05;
  const ChartIds refined = Refined(surface, ids, params);
  EXPECT_LT(Seams(surface, refined), 0.95 * Seams(surface, ids));
  EXPECT_LE(WorstStretch(surface, refined), std::max(WorstStretch(surface, ids), params.max_stretch));
  EXPECT_EQ(ChartCount(refined), ChartCount(ids));
  EXPECT_TRUE(test::ChartsAreWhole(*surface, refined));
}

// Where seams cost nothing they go where the charts lie flattest.
TEST(RefineBorders, SeamWeightIsTheTrade) {
  const TestSurface surface(shapes::SphericalCap(16, 1.2));
  const ChartIds ids =
      surface.Paint([](const auto& p) { return p[0] + 0.15 * std::sin(9 * p[1]) > 0.2 ? 0 : 1; });
  Params cheap, dear;
  cheap.seam_weight = 0;
  dear.seam_weight = 30;
  cheap.max_stretch = dear.max_stretch = 0;
  EXPECT_GT(Seams(surface, Refined(surface, ids, cheap)), Seams(surface, Refined(surface, ids, dear)));
  EXPECT_LE(WorstStretch(surface, Refined(surface, ids, cheap)),
            WorstStretch(surface, Refined(surface, ids, dear)));
}

TEST(RefineBorders, OneChartStays) {
  const TestSurface surface(shapes::Cube(4));
  const ChartIds one(surface->FaceCount(), 0);
  EXPECT_EQ(Refined(surface, one), one);
}

}  // namespace
}  // namespace dcharts
