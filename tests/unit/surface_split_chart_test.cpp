// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/split_chart.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

double SeamBetween(const ChartPatch& patch, const std::vector<int>& side) {
  double length = 0;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h)
    if (patch.opposite[h] > h && side[h / 3] != side[patch.opposite[h] / 3]) length += patch.Length(h);
  return length;
}

double AreaOfSide(const ChartPatch& patch, const std::vector<int>& side, int which) {
  double area = 0;
  for (int f = 0; f < static_cast<int>(patch.faces.size()); ++f)
    if (side[f] == which) area += patch.FaceArea(f);
  return area;
}

void ExpectTwoSides(const ChartPatch& patch, const std::vector<int>& side) {
  ASSERT_EQ(side.size(), patch.faces.size());
  for (int s : side) EXPECT_TRUE(s == 0 || s == 1);
  EXPECT_GT(std::count(side.begin(), side.end(), 0), 0);
  EXPECT_GT(std::count(side.begin(), side.end(), 1), 0);
}

TEST(Bisect, PartsALongSheetAcross) {
  SurfaceData mesh = shapes::Grid(40, 8);
  for (auto& p : mesh.vertices) p[0] *= 5;
  const TestSurface surface(mesh);
  const ChartPatch patch = surface.WholePatch();
  const std::vector<int> side = Bisect(patch);
  ExpectTwoSides(patch, side);
  EXPECT_NEAR(SeamBetween(patch, side) / surface.Scale(), 1, 1e-9) << "the shortest cut across";
  EXPECT_NEAR(AreaOfSide(patch, side, 0) / patch.Area(), 0.5, 0.15);
}

TEST(Bisect, FindsTheWaist) {
  SurfaceData mesh = shapes::Grid(40, 10);
  for (auto& p : mesh.vertices) p[1] = (p[1] - 0.5) * (0.2 + 2.5 * std::abs(p[0] - 0.5)), p[0] *= 4;
  const TestSurface surface(mesh);
  const ChartPatch patch = surface.WholePatch();
  const std::vector<int> side = Bisect(patch);
  ExpectTwoSides(patch, side);
  EXPECT_NEAR(SeamBetween(patch, side) / surface.Scale(), 0.2, 0.01);
}

TEST(Bisect, AnyPatchOfTwoOrMoreFaces) {
  for (const SurfaceData& mesh : {shapes::Grid(1, 1), shapes::Cube(1), shapes::Torus(8), shapes::Sphere(4),
                                  shapes::OpenCone(12), shapes::Disk(1)}) {
    const ChartPatch patch = TestSurface(mesh).WholePatch();
    ExpectTwoSides(patch, Bisect(patch));
  }
}

TEST(Bisect, EndsAtSingleFaces) {
  // Bisecting again and again: each part is smaller.
  const TestSurface surface(shapes::Sphere(3));
  ChartIds ids(surface->FaceCount(), 0);
  for (int round = 0; round < surface->FaceCount() && ChartCount(ids) < surface->FaceCount(); ++round) {
    const SeamMask seams = ChartBorders(*surface, ids);
    const int charts = ChartCount(ids);
    int next = charts;
    for (int c = 0; c < charts; ++c) {
      const ChartPatch patch = surface.Patch(ids, seams, c);
      if (patch.faces.size() < 2) continue;
      const std::vector<int> side = Bisect(patch);
      ExpectTwoSides(patch, side);
      for (size_t f = 0; f < side.size(); ++f)
        if (side[f]) ids[patch.faces[f]] = next;
      ++next;
    }
    SplitAndCompact(*surface, ids);
  }
  EXPECT_EQ(ChartCount(ids), surface->FaceCount());
}

TEST(Bisect, FacesInOnePlace) {
  // No extent at all, as of faces without area.
  ChartPatch patch = TestSurface(shapes::Grid(2, 2)).WholePatch();
  patch.mesh.positions.setZero();
  ExpectTwoSides(patch, Bisect(patch));
}

TEST(SplitAtOverlaps, PartsThePair) {
  const TestSurface surface(shapes::Grid(20, 6));
  const ChartPatch patch = surface.WholePatch();
  const int last = static_cast<int>(patch.faces.size()) - 1;
  const std::vector<int> side = SplitAtOverlaps(patch, {{0, last}});
  ExpectTwoSides(patch, side);
  EXPECT_NE(side[0], side[last]);
}

// The two ends of a strip overlap: all faces of one end come to one side, of the other to the other.
TEST(SplitAtOverlaps, PartsTwoOverlappingEnds) {
  SurfaceData mesh = shapes::Grid(30, 4);
  for (auto& p : mesh.vertices) p[0] *= 7;
  const TestSurface surface(mesh);
  const ChartPatch patch = surface.WholePatch();
  auto x = [&](int f) {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      sum += patch.mesh.positions(patch.mesh.triangles(f, i), 0) / 3 / surface.Scale() + 7.0 / 6;
    return sum;
  };
  std::vector<int> left, right;
  for (int f = 0; f < static_cast<int>(patch.faces.size()); ++f) {
    if (x(f) < 1) left.push_back(f);
    if (x(f) > 6) right.push_back(f);
  }
  std::vector<std::pair<int, int>> overlaps;
  for (int l : left)
    for (int r : right) overlaps.push_back({std::min(l, r), std::max(l, r)});
  std::sort(overlaps.begin(), overlaps.end());
  ASSERT_FALSE(overlaps.empty());
  const std::vector<int> side = SplitAtOverlaps(patch, overlaps);
  ExpectTwoSides(patch, side);
  for (int l : left) EXPECT_EQ(side[l], side[left[0]]);
  for (int r : right) EXPECT_EQ(side[r], 1 - side[left[0]]);
  EXPECT_NEAR(SeamBetween(patch, side) / surface.Scale(), 1, 1e-9) << "the shortest seam";
}

TEST(SplitAtOverlaps, NeighboursThatOverlap) {
  const TestSurface surface(shapes::Grid(4, 4));
  const ChartPatch patch = surface.WholePatch();
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    if (patch.opposite[h] < h) continue;
    const std::vector<int> side = SplitAtOverlaps(patch, {{h / 3, patch.opposite[h] / 3}});
    EXPECT_NE(side[h / 3], side[patch.opposite[h] / 3]);
  }
}

TEST(SplitAtOverlaps, EverythingOverlapsEverything) {
  const TestSurface surface(shapes::Grid(3, 3));
  const ChartPatch patch = surface.WholePatch();
  std::vector<std::pair<int, int>> overlaps;
  const int n = static_cast<int>(patch.faces.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) overlaps.push_back({i, j});
  ExpectTwoSides(patch, SplitAtOverlaps(patch, overlaps));
}

}  // namespace
}  // namespace dcharts
