// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/trial_merge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "surface/cut.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

ChartIds Merged(const TestSurface& surface, ChartIds ids, const Params& params = {}) {
  Progress progress;
  KnownFlattenings known;
  TrialMerger<SurfaceMesh>(*surface, params, progress).Run(ids, known);
  return ids;
}

Params Target(int count) {
  Params params;
  params.target_charts = count;
  return params;
}

ChartIds Octants(const TestSurface& surface) {
  ChartIds ids = surface.Paint(
      [](const auto& p) { return (p[0] > 0 ? 1 : 0) + (p[1] > 0 ? 2 : 0) + (p[2] > 0 ? 4 : 0); });
  SplitAndCompact(*surface, ids);
  return ids;
}

// n by n squares of a unit square, or n^3 boxes of a unit cube.
ChartIds Boxes(const TestSurface& surface, int n) {
  ChartIds ids = surface.Paint([n](const auto& p) {
    auto cell = [n](double x) { return std::clamp(static_cast<int>(std::floor(x * n)), 0, n - 1); };
    return cell(p[0]) + n * cell(p[1]) + n * n * cell(p[2]);
  });
  SplitAndCompact(*surface, ids);
  return ids;
}

ChartIds CubeSides(const TestSurface& surface) {
  return surface.Paint([](const auto& p) { return test::CubeSide(p, {0.5, 0.5, 0.5}, 0.5); });
}

void ExpectExactly(const TestSurface& surface, const ChartIds& ids, int target) {
  const ChartIds merged = Merged(surface, ids, Target(target));
  EXPECT_EQ(ChartCount(merged), target);
  EXPECT_TRUE(test::ChartsAreWhole(*surface, merged));
  EXPECT_EQ(std::count(merged.begin(), merged.end(), kUnassigned), 0);
}

TEST(TrialMerge, PlaneReachesAnyTarget) {
  const TestSurface surface(shapes::Grid(24, 24));
  const ChartIds ids = Boxes(surface, 12);
  ASSERT_EQ(ChartCount(ids), 144);
  for (int target : {1, 2, 3, 7, 40, 143, 144}) ExpectExactly(surface, ids, target);
}

TEST(TrialMerge, CubeReachesAnyTarget) {
  const TestSurface surface(shapes::Cube(6));
  const ChartIds ids = Boxes(surface, 3);
  for (int target : {2, 3, 6, 11}) ExpectExactly(surface, ids, target);
}

TEST(TrialMerge, SphereReachesAnyTarget) {
  const TestSurface surface(shapes::Sphere(10));
  const ChartIds ids = Octants(surface);
  for (int target : {2, 3, 5, 8}) ExpectExactly(surface, ids, target);
}

TEST(TrialMerge, TorusReachesAnyTarget) {
  const TestSurface surface(shapes::Torus(16));
  const ChartIds ids = surface.Paint([](const auto& p) {
    return static_cast<int>((std::atan2(p[1], p[0]) + 3.1416) / 0.7) +
           9 * (std::hypot(p[0], p[1]) > 1 ? 1 : 0);
  });
  ASSERT_EQ(ChartCount(ids), 18);
  for (int target : {2, 4, 9, 17}) ExpectExactly(surface, ids, target);
}

TEST(TrialMerge, PiecesOfADevelopableShapeBecomeOneChart) {
  const TestSurface plane(shapes::Grid(12, 12));
  EXPECT_EQ(ChartCount(Merged(plane, Boxes(plane, 4))), 1);
  const TestSurface cylinder(shapes::OpenCylinder(24));
  const ChartIds stripes =
      cylinder.Paint([](const auto& p) { return static_cast<int>((std::atan2(p[1], p[0]) + 3.15) / 1.06); });
  ASSERT_EQ(ChartCount(stripes), 6);
  EXPECT_EQ(ChartCount(Merged(cylinder, stripes)), 1);
  const TestSurface cube(shapes::Cube(6));
  EXPECT_EQ(ChartCount(Merged(cube, CubeSides(cube))), 1) << "six squares unfold without stretch";
}

// L2 stretch of each chart of the finished cuts, at its own scale.
std::vector<double> StretchAfterCut(const TestSurface& surface, ChartIds& ids, const Params& params) {
  Progress progress;
  KnownFlattenings known;
  SeamMask seams;
  ChartCutter<SurfaceMesh>(*surface, params, progress).Run(ChartsFor::kPattern, ids, seams, known);
  std::vector<double> stretch;
  FlattenOptions options;
  options.l2_bound = params.max_stretch;
  for (int c = 0; c < ChartCount(ids); ++c)
    stretch.push_back(Flatten(surface.Patch(ids, seams, c).mesh, options).l2_stretch);
  return stretch;
}

TEST(TrialMerge, EveryChartKeepsWithinMaxStretch) {
  for (const SurfaceData& mesh :
       {shapes::Sphere(8), shapes::Torus(12), shapes::SaddleRidge(12), shapes::Cube(4)}) {
    const TestSurface surface(mesh);
    for (double bound : {1.002, 1.01, 1.1}) {
      Params params;
      params.max_stretch = bound;
      const ChartIds merged = Merged(surface, Octants(surface), params);
      EXPECT_TRUE(test::ChartsAreWhole(*surface, merged));
      ChartIds cut = merged;
      for (double l2 : StretchAfterCut(surface, cut, params)) {
        EXPECT_GE(l2, 1 - 1e-12);
        EXPECT_LE(l2, bound);
      }
      EXPECT_EQ(cut, merged) << "Cut needn't part what Merge has joined: " << bound;
    }
  }
}

// Large surfaces are checked on a copy with fewer faces (ChartParts::FinePatch).
TEST(TrialMerge, ChartsOfALargeSurfaceKeepWithinMaxStretch) {
  const TestSurface surface(shapes::Sphere(62));
  ASSERT_GT(surface->FaceCount(), ChartParts<SurfaceMesh>::kFineFaces);
  Params params;
  params.max_stretch = 1.05;
  const ChartIds merged = Merged(surface, Octants(surface), params);
  EXPECT_EQ(ChartCount(merged), 1) << "with darts the whole ball is within the bound";
  EXPECT_TRUE(test::ChartsAreWhole(*surface, merged));
  ChartIds cut = merged;
  for (double l2 : StretchAfterCut(surface, cut, params)) EXPECT_LE(l2, params.max_stretch);
  EXPECT_EQ(cut, merged) << "what holds on the copy holds on the surface";
}

TEST(TrialMerge, AChartThatIsNotFlatIsSplitFirst) {
  const TestSurface surface(shapes::Sphere(8));
  const ChartIds one(surface->FaceCount(), 0);
  Params params;
  params.max_dart_percent = 0;  // three darts would do as well
  const ChartIds merged = Merged(surface, one, params);
  EXPECT_GE(ChartCount(merged), 2);
  EXPECT_TRUE(test::ChartsAreWhole(*surface, merged));
}

TEST(TrialMerge, WithoutBoundAndTargetASeamMustBeWorthItsStretch) {
  const TestSurface surface(shapes::Sphere(10));
  const ChartIds ids = Octants(surface);
  Params params;
  params.max_stretch = 0;
  std::vector<int> counts;
  for (double weight : {0.0, 1.0, 1000.0}) {
    params.seam_weight = weight;
    counts.push_back(ChartCount(Merged(surface, ids, params)));
  }
  EXPECT_EQ(counts[0], 8) << "seams cost nothing: no stretch is taken for them";
  EXPECT_LT(counts[1], 8);
  EXPECT_GT(counts[1], 1) << "merges stop";
  EXPECT_LE(counts[2], counts[1]);
}

// What is flat stays worth merging even where seams cost nearly nothing.
TEST(TrialMerge, WithoutBoundAndTargetFlatPiecesMerge) {
  const TestSurface surface(shapes::Grid(12, 12));
  Params params;
  params.max_stretch = 0;
  params.seam_weight = 0.01;
  EXPECT_EQ(ChartCount(Merged(surface, Boxes(surface, 3), params)), 1);
}

TEST(TrialMerge, ComponentsNeverMerge) {
  for (const SurfaceData& mesh : {shapes::TwoComponents(5), shapes::BowTie(6)}) {
    const TestSurface surface(mesh);
    ChartIds components(surface->FaceCount(), 0);
    SplitAndCompact(*surface, components);
    const int count = ChartCount(components);
    ASSERT_EQ(count, 2);
    const ChartIds merged = Merged(surface, Octants(surface), Target(1));
    EXPECT_GE(ChartCount(merged), count);
    std::map<int, int> component_of;
    for (int f = 0; f < surface->FaceCount(); ++f)
      EXPECT_EQ(component_of.emplace(merged[f], components[f]).first->second, components[f]);
  }
  const TestSurface sheets(shapes::BowTie(6));
  EXPECT_EQ(ChartCount(Merged(sheets, Octants(sheets), Target(1))), 2) << "as near as one can come";
}

TEST(TrialMerge, EdgesWithThreeFacesStaySeams) {
  const TestSurface surface(shapes::NonManifoldFin(6));
  ChartIds components(surface->FaceCount(), 0);
  SplitAndCompact(*surface, components);
  const ChartIds merged = Merged(surface, Octants(surface), Target(1));
  EXPECT_EQ(ChartCount(merged), ChartCount(components));
  EXPECT_EQ(ChartBorders(*surface, merged), ChartBorders(*surface, components));
}

TEST(TrialMerge, WeightOnSeamsGivesShorterOnes) {
  const TestSurface surface(shapes::Plush(32));
  const ChartIds ids = Boxes(surface, 4);
  std::vector<double> length;
  for (double weight : {0.0, 1000.0}) {
    Params params = Target(10);
    params.seam_weight = weight;
    const ChartIds merged = Merged(surface, ids, params);
    ASSERT_EQ(ChartCount(merged), 10);
    length.push_back(SeamLength(*surface, ChartBorders(*surface, merged)));
  }
  EXPECT_LT(length[1], length[0]);
}

TEST(TrialMerge, TheSameEveryTime) {
  const TestSurface surface(shapes::Torus(14));
  const ChartIds ids = Octants(surface);
  EXPECT_EQ(Merged(surface, ids), Merged(surface, ids));
}

// No two places of it are alike: nothing is left to the numbering.
SurfaceData Irregular() {
  SurfaceData mesh = shapes::Sphere(8);
  std::mt19937 random(77);
  std::uniform_real_distribution<double> jitter(-0.004, 0.004);
  for (auto& p : mesh.vertices) {
    const double x = p[0], y = p[1], z = p[2];
    p = {x + 0.1 * std::sin(3 * y + 1) + jitter(random),
         1.2 * y + 0.08 * std::cos(2 * z + x) + jitter(random), 0.9 * z + 0.07 * x * y + jitter(random)};
  }
  return mesh;
}

TEST(TrialMerge, NumbersOfVerticesAndFacesDoNotMatter) {
  const SurfaceData mesh = Irregular();
  std::mt19937 random(5);
  std::vector<int> vertex(mesh.vertices.size()), face(mesh.faces.size());
  std::iota(vertex.begin(), vertex.end(), 0);
  std::iota(face.begin(), face.end(), 0);
  std::shuffle(vertex.begin(), vertex.end(), random);
  std::shuffle(face.begin(), face.end(), random);
  SurfaceData shuffled = mesh;
  for (size_t v = 0; v < vertex.size(); ++v) shuffled.vertices[vertex[v]] = mesh.vertices[v];
  for (size_t f = 0; f < face.size(); ++f)
    for (size_t i = 0; i < 3; ++i) shuffled.faces[face[f]][i] = vertex[mesh.faces[f][i]];

  const TestSurface a(mesh), b(shuffled);
  for (const Params& params : {Params(), Target(3)}) {
    const ChartIds merged = Merged(a, Octants(a), params), others = Merged(b, Octants(b), params);
    EXPECT_EQ(ChartCount(merged), ChartCount(others));
    std::map<int, int> same;  // chart of one: chart of the other
    for (size_t f = 0; f < face.size(); ++f)
      EXPECT_EQ(same.emplace(merged[f], others[face[f]]).first->second, others[face[f]]) << f;
  }
}

}  // namespace
}  // namespace dcharts
