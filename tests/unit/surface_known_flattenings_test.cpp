// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/known_flattenings.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "surface/charts.h"
#include "surface/seams.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

// The edges of the patch on the line x = 1/2, y < 1/2 of the unit square: a slit from its border.
std::vector<int> Slit(const TestSurface& surface, const ChartPatch& patch) {
  std::vector<int> edges;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    if (patch.opposite[h] < h) continue;
    bool on_line = true;
    for (int k : {h, Next(h)}) {
      const auto& p = surface.InputPosition(surface->Vertex(patch.SurfaceHalfEdge(k)));
      on_line &= std::abs(p[0] - 0.5) < 1e-9 && p[1] < 0.5 + 1e-9;
    }
    if (on_line) edges.push_back(h);
  }
  return edges;
}

TEST(KnownFlattenings, FoundWhenFacesAndCutsAreTheSame) {
  const TestSurface surface(shapes::Grid(8, 8));
  const ChartPatch whole = surface.WholePatch();
  const std::vector<int> slit = Slit(surface, whole);
  ASSERT_EQ(slit.size(), 4u);
  const ChartPatch open = CutOpen(whole, slit);
  KnownFlattenings known;
  EXPECT_EQ(known.Find(open), nullptr);
  known.Add(open, Flatten(open.mesh));
  const Flattening* found = known.Find(open);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->uv, Flatten(open.mesh).uv);
  EXPECT_EQ(known.Find(whole), nullptr) << "not cut";
  EXPECT_EQ(known.Find(CutOpen(whole, {slit[0]})), nullptr) << "cut otherwise";

  // A patch cut open, and one taken out along the same seams, are numbered alike.
  SeamMask seams(surface->FaceCount(), 0);
  for (int h : slit) {
    SetSeam(seams, whole.SurfaceHalfEdge(h));
    SetSeam(seams, surface->Opposite(whole.SurfaceHalfEdge(h)));
  }
  const ChartPatch taken = surface.Patch(ChartIds(surface->FaceCount(), 0), seams, 0);
  EXPECT_EQ(known.Find(taken), found);
  EXPECT_EQ(taken.mesh.triangles, open.mesh.triangles);
  EXPECT_EQ(taken.mesh.positions, open.mesh.positions);
}

TEST(KnownFlattenings, OtherFacesAreAnotherChart) {
  const TestSurface surface(shapes::Grid(8, 8));
  const SeamMask no_seams(surface->FaceCount(), 0);
  const ChartIds halves = surface.Paint([](const auto& p) { return p[1] < 0.5 ? 0 : 1; });
  const ChartPatch whole = surface.WholePatch(), half = surface.Patch(halves, no_seams, 0),
                   other = surface.Patch(halves, no_seams, 1);
  ASSERT_EQ(whole.faces.front(), half.faces.front());
  KnownFlattenings known;
  known.Add(whole, Flatten(whole.mesh));
  EXPECT_EQ(known.Find(half), nullptr) << "the same first face";
  EXPECT_EQ(known.Find(other), nullptr);
  known.Add(half, Flatten(half.mesh));
  known.Add(other, Flatten(other.mesh));
  ASSERT_NE(known.Find(half), nullptr);
  ASSERT_NE(known.Find(other), nullptr);
  EXPECT_EQ(known.Find(half)->uv, Flatten(half.mesh).uv);
  EXPECT_EQ(known.Find(whole), nullptr) << "the newer one took its place";
}

TEST(KnownFlattenings, DartsAreThoseOfAGoal) {
  const TestSurface surface(shapes::SphericalCap(12, 1.5));
  const ChartPatch patch = surface.WholePatch();
  DartGoal goal;
  goal.l2_stretch = 1.01;
  goal.linf_stretch = std::numeric_limits<double>::infinity();
  goal.longest = patch.Diagonal();
  const DartedChart darted = CutStretchDarts(patch, goal, [] {});
  ASSERT_LE(darted.flat.l2_stretch, goal.l2_stretch);
  KnownFlattenings known;
  EXPECT_EQ(known.Of(patch, goal).mean_darts, nullptr);
  known.AddDarts(patch, goal, darted);
  const DartedChart* const found = known.Of(patch, goal).mean_darts;
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->edges, darted.edges);
  EXPECT_EQ(known.Of(CutOpen(patch, darted.edges), goal).mean_darts, nullptr) << "another chart";
  for (double DartGoal::*figure : {&DartGoal::l2_stretch, &DartGoal::longest}) {
    DartGoal other = goal;
    other.*figure *= 1.001;
    EXPECT_EQ(known.Of(patch, other).mean_darts, nullptr);
  }
  DartGoal fewer = goal;
  fewer.most_darts = goal.most_darts - 1;
  EXPECT_EQ(known.Of(patch, fewer).mean_darts, nullptr) << "it may not have come to the same";

  DartGoal strict = goal;
  strict.l2_stretch = 1;
  KnownFlattenings unreached;
  unreached.AddDarts(patch, strict, darted);
  EXPECT_EQ(unreached.Of(patch, strict).mean_darts, nullptr);
}

}  // namespace
}  // namespace dcharts
