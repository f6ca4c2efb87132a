// SPDX-License-Identifier: GPL-3.0-or-later
/// Charts larger than a page, cut along straight lines.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/errors.h"
#include "pattern/chart_cut.h"
#include "pattern/page_cuts.h"
#include "pattern_fixture.h"
#include "planar/distortion.h"
#include "shapes.h"

namespace dcharts {
namespace {

using test::ChartsOf;
using test::FromAbove;

const Point2 kPage(176, 263);

SurfaceData Scaled(SurfaceData mesh, double x, double y) {
  Eigen::AlignedBox2d box;
  for (const auto& v : mesh.vertices) box.extend(Point2(v[0], v[1]));
  for (auto& v : mesh.vertices) {
    v[0] = (v[0] - box.min().x()) / box.sizes().x() * x;
    v[1] = (v[1] - box.min().y()) / box.sizes().y() * y;
  }
  return mesh;
}

// A flat chart of a mesh in the plane, the faces where `keep` says so.
FlatCharts OneChart(SurfaceData mesh, const std::function<bool(double, double)>& keep = {}) {
  std::vector<std::array<int, 3>> faces;
  for (const auto& face : mesh.faces) {
    double x = 0, y = 0;
    for (int v : face) {
      x += mesh.vertices[v][0] / 3;
      y += mesh.vertices[v][1] / 3;
    }
    if (!keep || keep(x, y)) faces.push_back(face);
  }
  mesh.faces = faces;
  return ChartsOf(
      mesh, [](const Point3&) { return 0; }, FromAbove);
}

double AreaOf(const FlatCharts& charts) {
  double area = 0;
  for (const FlatChart& chart : charts.charts) area += MeasureStretch(chart.mesh, chart.uv).UvArea();
  return area;
}

// Of the edges with two sides, mm.
double SeamLength(const FlatCharts& charts) {
  double length = 0;
  for (const auto& edge : charts.edges) {
    if (edge.size() < 2) continue;
    const FlatChart& chart = charts.charts[edge[0].chart];
    length +=
        (chart.uv.row(StartOf(chart, edge[0].half_edge)) - chart.uv.row(EndOf(chart, edge[0].half_edge)))
            .norm();
  }
  return length;
}

// Vertices - edges + faces of what the charts make when they are put together.
int EulerOf(const FlatCharts& charts) {
  std::set<int> vertices;
  size_t faces = 0, inner = 0;
  for (const FlatChart& chart : charts.charts) {
    vertices.insert(chart.model_vertex.begin(), chart.model_vertex.end());
    faces += chart.mesh.triangles.rows();
  }
  size_t sides = 0;
  for (const auto& edge : charts.edges) sides += edge.size();
  inner = (3 * faces - sides) / 2;
  return static_cast<int>(vertices.size() + faces) - static_cast<int>(inner + charts.edges.size());
}

// Boundary edges are those without a triangle beside them, each is there once, and sides are equally long.
void ExpectSound(const FlatCharts& charts) {
  std::vector<std::set<int>> listed(charts.charts.size());
  for (const auto& edge : charts.edges)
    for (const ChartEdge& side : edge) {
      EXPECT_TRUE(listed[side.chart].insert(side.half_edge).second);
      const FlatChart &chart = charts.charts[side.chart], &first = charts.charts[edge[0].chart];
      const auto length = [](const FlatChart& c, int h) {
        return (c.uv.row(StartOf(c, h)) - c.uv.row(EndOf(c, h))).norm();
      };
      EXPECT_NEAR(length(chart, side.half_edge), length(first, edge[0].half_edge), 1e-9);
      const std::set<int> ends = {chart.model_vertex[StartOf(chart, side.half_edge)],
                                  chart.model_vertex[EndOf(chart, side.half_edge)]},
                          first_ends = {first.model_vertex[StartOf(first, edge[0].half_edge)],
                                        first.model_vertex[EndOf(first, edge[0].half_edge)]};
      EXPECT_EQ(ends, first_ends);
    }
  for (size_t c = 0; c < charts.charts.size(); ++c) {
    const FlatChart& chart = charts.charts[c];
    std::set<std::pair<int, int>> edges;
    for (int h = 0; h < 3 * chart.mesh.triangles.rows(); ++h)
      EXPECT_TRUE(edges.insert({StartOf(chart, h), EndOf(chart, h)}).second);
    for (int h = 0; h < 3 * chart.mesh.triangles.rows(); ++h)
      EXPECT_EQ(edges.count({EndOf(chart, h), StartOf(chart, h)}) == 0, listed[c].count(h) == 1);
    EXPECT_EQ(chart.source_face.size(), static_cast<size_t>(chart.mesh.triangles.rows()));
    std::set<int> leaving;
    for (int h : listed[c])
      EXPECT_TRUE(leaving.insert(StartOf(chart, h)).second) << "the outline touches itself";
  }
}

void ExpectOnPages(const FlatCharts& charts, const FlatCharts& before) {
  ExpectSound(charts);
  for (const FlatChart& chart : charts.charts) EXPECT_EQ(PagesFor(chart, kPage), 1);
  EXPECT_NEAR(AreaOf(charts), AreaOf(before), 1e-6 * AreaOf(before));
  EXPECT_EQ(EulerOf(charts), EulerOf(before));
}

FlatCharts Cut(FlatCharts charts) {
  CutToPages(kPage, {}, charts);
  return charts;
}

TEST(PageCuts, PagesForTurnsPieces) {
  EXPECT_EQ(PagesFor(test::Rectangle(280, 30), {200, 290}), 1);
  EXPECT_EQ(PagesFor(test::Rectangle(400, 30), {200, 290}), 2);
  EXPECT_EQ(PagesFor(test::Rectangle(390, 570), {200, 290}), 4);
}

TEST(PageCuts, WhatFitsStaysWhole) {
  FlatCharts charts = OneChart(Scaled(shapes::Grid(6, 6), 170, 250));
  EXPECT_EQ(CutToPages(kPage, {}, charts), 0);
  EXPECT_EQ(charts.charts.size(), 1u);
}

TEST(PageCuts, ALongStripIsCutAcross) {
  const FlatCharts before = OneChart(Scaled(shapes::Grid(30, 3), 900, 40));
  FlatCharts charts = before;
  EXPECT_EQ(CutToPages(kPage, {}, charts), 3);
  EXPECT_EQ(charts.charts.size(), 4u);
  EXPECT_LT(SeamLength(charts), 1.1 * 3 * 40);
  ExpectOnPages(charts, before);
}

TEST(PageCuts, AnLIsCutAcrossAnArm) {
  const FlatCharts before =
      OneChart(Scaled(shapes::Grid(25, 25), 250, 250), [](double x, double y) { return x < 80 || y < 80; });
  const FlatCharts charts = Cut(before);
  EXPECT_EQ(charts.charts.size(), 2u);
  EXPECT_LT(SeamLength(charts), 1.1 * 80);
  ExpectOnPages(charts, before);
}

TEST(PageCuts, ADiskBecomesAsFewPartsAsPages) {
  const FlatCharts before = OneChart(Scaled(shapes::Disk(12), 400, 400));
  const FlatCharts charts = Cut(before);
  EXPECT_LE(charts.charts.size(), 6u);  // two by three pages
  EXPECT_LT(SeamLength(charts), 3 * 400);
  ExpectOnPages(charts, before);
}

TEST(PageCuts, AHoleIsOpened) {
  const FlatCharts before = OneChart(Scaled(shapes::PlaneWithHole(24), 400, 400));
  const FlatCharts charts = Cut(before);
  EXPECT_LE(charts.charts.size(), 9u);
  ExpectOnPages(charts, before);
}

TEST(PageCuts, AHoleWithCornersIsNoPlaceForSlivers) {
  const auto keep = [](double x, double y) {
    return !(x > 100 && x < 300 && y > 100 && y < 300 && (x < 150 || y < 150));
  };
  const FlatCharts before = OneChart(Scaled(shapes::Grid(24, 24), 400, 400), keep);
  const FlatCharts charts = Cut(before);
  EXPECT_LE(charts.charts.size(), 9u);
  for (const FlatChart& chart : charts.charts)
    EXPECT_GT(MeasureStretch(chart.mesh, chart.uv).UvArea(), 0.02 * 400 * 400);
  ExpectOnPages(charts, before);
}

TEST(PageCuts, TheNeighboursEdgesArePartedToo) {
  const SurfaceData grid = Scaled(shapes::Grid(2, 2), 400, 400);
  const FlatCharts before = ChartsOf(
      grid, [](const Point3& p) { return p.x() < 200 ? 0 : 1; }, FromAbove);
  const FlatCharts charts = Cut(before);
  EXPECT_GT(charts.charts.size(), 5u);
  ExpectOnPages(charts, before);
}

// A tube laid flat: its left side is sewn to its right side, so a cut across it parts both sides of one edge.
TEST(PageCuts, ATubeIsCutAcross) {
  FlatCharts before = OneChart(Scaled(shapes::Grid(8, 30), 120, 900));
  FlatChart& chart = before.charts[0];
  const auto at = [&](int v) -> Point2 { return chart.uv.row(v).transpose(); };
  std::vector<std::vector<ChartEdge>> edges;
  for (const auto& edge : before.edges) {
    const int h = edge[0].half_edge;
    const Point2 a = at(StartOf(chart, h)), b = at(EndOf(chart, h));
    if (a.x() > 119 && b.x() > 119) continue;
    edges.push_back(edge);
    if (a.x() > 1 || b.x() > 1) continue;
    for (const auto& other : before.edges) {
      const int g = other[0].half_edge;
      if (at(StartOf(chart, g)).x() < 119 || at(EndOf(chart, g)).x() < 119) continue;
      if (std::abs(at(StartOf(chart, g)).y() - b.y()) < 1 && std::abs(at(EndOf(chart, g)).y() - a.y()) < 1)
        edges.back().push_back(other[0]);
    }
  }
  before.edges = edges;
  for (Eigen::Index v = 0; v < chart.uv.rows(); ++v)
    for (Eigen::Index w = 0; w < chart.uv.rows(); ++w)
      if (chart.uv(v, 0) > 119 && chart.uv(w, 0) < 1 && std::abs(chart.uv(v, 1) - chart.uv(w, 1)) < 1)
        chart.model_vertex[v] = chart.model_vertex[w];
  ASSERT_EQ(EulerOf(before), 0);
  const FlatCharts charts = Cut(before);
  EXPECT_LE(charts.charts.size(), 4u);
  EXPECT_LT(SeamLength(charts), SeamLength(before) + 1.1 * 3 * 120);
  ExpectOnPages(charts, before);
}

// They would take long: 200 took half a minute with sanitizers.
TEST(PageCuts, HundredsOfPagesAreRefused) {
  for (const double side : {2800.0, 5000.0}) {
    FlatCharts charts = OneChart(Scaled(shapes::Grid(2, 2), side, side));
    EXPECT_THROW(CutToPages(kPage, {}, charts), Error);
  }
}

// Corners that are cut off leave more to cut: 23 parts, and 313 of a sheet of 2 m, which took half a minute.
TEST(PageCuts, LargeSheetsAreCutInFewDirections) {
  const FlatCharts before = OneChart(Scaled(shapes::Grid(2, 2), 600, 600));
  ASSERT_EQ(PagesFor(before.charts[0], kPage), 12);
  const FlatCharts charts = Cut(before);
  EXPECT_LE(charts.charts.size(), 16u);
  ExpectOnPages(charts, before);
}

// Each cut made three triangles of each that it crosses: 150,000 of one after 90 cuts, which took half a
// minute.
TEST(PageCuts, ManyCutsMakeFewTriangles) {
  SurfaceData triangle;
  triangle.vertices = {{0, 0, 0}, {1700, 0, 0}, {300, 1400, 0}};
  triangle.faces = {{0, 1, 2}};
  const FlatCharts before = OneChart(triangle);
  const FlatCharts charts = Cut(before);
  EXPECT_GT(charts.charts.size(), 30u);
  ExpectOnPages(charts, before);
  for (const FlatChart& chart : charts.charts) {
    EXPECT_LT(chart.mesh.triangles.rows(), 100);
    EXPECT_LT((chart.mesh.positions.leftCols(2) - chart.uv).cwiseAbs().maxCoeff(), 1e-9) << "another map";
  }
}

TEST(PageCuts, OneTriangleIsEnough) {
  SurfaceData triangle;
  triangle.vertices = {{0, 0, 0}, {600, 0, 0}, {0, 500, 0}};
  triangle.faces = {{0, 1, 2}};
  const FlatCharts before = OneChart(triangle);
  const FlatCharts charts = Cut(before);
  EXPECT_LE(charts.charts.size(), 8u);
  ExpectOnPages(charts, before);
}

}  // namespace
}  // namespace dcharts
