// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/merge_pieces.h"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

std::vector<int> Merged(const TestSurface& surface, const ChartIds& ids, double bound) {
  Progress progress;
  PieceMerger<SurfaceMesh> merger(*surface, bound, ChartBorders(*surface, ids), progress);
  return merger.Run(FacesOfCharts(ids));
}

TEST(PieceMerger, StripsOfAPlaneBecomeOne) {
  const TestSurface surface(shapes::Grid(12, 8));
  const ChartIds strips =
      surface.Paint([](const auto& p) { return std::min(3, static_cast<int>(4 * p[0])); });
  ASSERT_EQ(ChartCount(strips), 4);
  const std::vector<int> parts = Merged(surface, strips, 1.01);
  EXPECT_EQ(parts, std::vector<int>(4, parts[0]));
}

TEST(PieceMerger, WhatIsMergedLiesFlat) {
  const TestSurface surface(shapes::Sphere(12));
  const ChartIds octants =
      surface.Paint([](const auto& p) { return (p[0] > 0) + 2 * (p[1] > 0) + 4 * (p[2] > 0); });
  int last = 9;
  for (const double bound : {1.001, 1.1, 1.3}) {
    const std::vector<int> parts = Merged(surface, octants, bound);
    ChartIds ids = octants;
    for (int& id : ids) id = parts[id];
    const int count = static_cast<int>(std::set<int>(parts.begin(), parts.end()).size());
    EXPECT_LE(count, last);
    last = count;
    for (int part : std::set<int>(parts.begin(), parts.end())) {
      std::vector<int> faces;
      for (int f = 0; f < surface->FaceCount(); ++f)
        if (ids[f] == part) faces.push_back(f);
      const SeamMask no_seams(surface->FaceCount(), 0);
      const ChartPatch patch = PatchExtractor<SurfaceMesh>(*surface, no_seams).Extract(faces);
      const bool is_merged = std::count(parts.begin(), parts.end(), part) > 1;
      EXPECT_TRUE(!is_merged || TryChart(patch, bound, [] {}).flat);
    }
    EXPECT_TRUE(bound > 1.001 || count == 8);
  }
  EXPECT_LT(last, 8);
}

TEST(PieceMerger, AKeptBorderStays) {
  const TestSurface surface(shapes::Grid(12, 8));
  const ChartIds strips =
      surface.Paint([](const auto& p) { return std::min(3, static_cast<int>(4 * p[0])); });
  SurfaceGraph<SurfaceMesh> parted = *surface;
  parted.Part(ChartBorders(*surface, surface.Paint([](const auto& p) { return p[0] > 0.5 ? 1 : 0; })));
  Progress progress;
  PieceMerger<SurfaceMesh> merger(parted, 1.01, ChartBorders(parted, strips), progress);
  const std::vector<int> parts = merger.Run(FacesOfCharts(strips));
  EXPECT_EQ(parts, (std::vector<int>{0, 0, 2, 2}));
}

}  // namespace
}  // namespace dcharts
