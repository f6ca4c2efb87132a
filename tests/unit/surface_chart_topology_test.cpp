// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/chart_topology.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

int EulerOfChart(const TestSurface& surface, const ChartIds& ids, int chart) {
  return ChartTopology<SurfaceMesh>(*surface).EulerPart(FacesOfCharts(ids)[chart], chart, ids);
}

int EulerOfAll(const SurfaceData& mesh) {
  const TestSurface surface(mesh);
  return EulerOfChart(surface, ChartIds(surface->FaceCount(), 0), 0);
}

TEST(ChartTopology, EulerOfKnownShapes) {
  EXPECT_EQ(EulerOfAll(shapes::Grid(5, 7)), 1);
  EXPECT_EQ(EulerOfAll(shapes::Disk(4)), 1);
  EXPECT_EQ(EulerOfAll(shapes::OpenCylinder(12)), 0);
  EXPECT_EQ(EulerOfAll(shapes::PlaneWithHole(12)), 0);
  EXPECT_EQ(EulerOfAll(shapes::Sphere(4)), 2);
  EXPECT_EQ(EulerOfAll(shapes::Torus(10)), 0);
  EXPECT_EQ(EulerOfAll(shapes::DoubleTorus(32)), -2);
}

TEST(ChartTopology, EulerOfChartsWithinASheet) {
  const TestSurface sheet(shapes::Grid(16, 16));
  const ChartIds ids = sheet.Paint([](const auto& p) {
    const double r = std::hypot(p[0] - 0.5, p[1] - 0.5);
    return r < 0.15 ? 0 : r < 0.35 ? 1 : 2;
  });
  EXPECT_EQ(EulerOfChart(sheet, ids, 0), 1);
  EXPECT_EQ(EulerOfChart(sheet, ids, 1), 0);
  EXPECT_EQ(EulerOfChart(sheet, ids, 2), 0);
}

// The point of it: what changes around some faces is what changes in all.
TEST(ChartTopology, AChangeIsSeenFromTheChangedFacesAlone) {
  std::mt19937 random(21);
  for (const SurfaceData& mesh : {shapes::Grid(6, 6), shapes::Sphere(3), shapes::Torus(8), shapes::Cube(3)}) {
    const TestSurface surface(mesh);
    ChartIds ids;
    for (int f = 0; f < surface->FaceCount(); ++f) ids.push_back(static_cast<int>(random() % 2));
    ChartTopology<SurfaceMesh> topology(*surface);
    std::vector<int> all;
    for (int f = 0; f < surface->FaceCount(); ++f) all.push_back(f);
    for (int trial = 0; trial < 40; ++trial) {
      std::vector<int> changed;
      for (int f : all)
        if (random() % 6 == 0) changed.push_back(f);
      for (int chart : {0, 1}) {
        const int total = topology.EulerPart(all, chart, ids), part = topology.EulerPart(changed, chart, ids);
        ChartIds other = ids;
        for (int f : changed) other[f] = 1 - ids[f];
        EXPECT_EQ(topology.EulerPart(all, chart, other) - total,
                  topology.EulerPart(changed, chart, other) - part);
      }
      for (int f : changed) ids[f] = 1 - ids[f];
    }
  }
}

TEST(ChartTopology, Connected) {
  const TestSurface sheet(shapes::Grid(9, 9));
  const ChartIds ids = sheet.Paint([](const auto& p) { return p[0] < 1.0 / 3 || p[0] > 2.0 / 3 ? 0 : 1; });
  ChartTopology<SurfaceMesh> topology(*sheet);
  std::vector<int> all;
  for (int f = 0; f < sheet->FaceCount(); ++f) all.push_back(f);
  const auto charts = FacesOfCharts(ids);
  EXPECT_FALSE(topology.IsConnected(0, charts[0], static_cast<int>(charts[0].size()), ids));
  EXPECT_TRUE(topology.IsConnected(1, charts[1], static_cast<int>(charts[1].size()), ids));
  EXPECT_TRUE(topology.IsConnected(1, all, static_cast<int>(charts[1].size()), ids)) << "others in the list";
  EXPECT_FALSE(topology.IsConnected(2, all, 0, ids)) << "no face at all";
}

}  // namespace
}  // namespace dcharts
