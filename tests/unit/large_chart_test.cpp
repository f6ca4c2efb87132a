// SPDX-License-Identifier: GPL-3.0-or-later
// Charts of more than 30,000 triangles: their maps are continued from coarser charts.
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "flatten_charts.h"
#include "planar/coarse_chart.h"
#include "planar/coarser_charts.h"
#include "planar/distortion.h"
#include "planar/flatten.h"
#include "planar/plane_points.h"
#include "planar/trial_flatten.h"
#include "planar/vertex_descent.h"
#include "thread_count.h"

namespace dcharts {
namespace {

constexpr int kLarge = 130;  // quads along a side: 33,800 triangles

// Moved in their own plane and out of it, like the vertices of a scan.
ChartMesh Noisy(ChartMesh chart, double deviation) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, deviation);
  for (Eigen::Index v = 0; v < chart.positions.rows(); ++v)
    for (int d = 0; d < 3; ++d) chart.positions(v, d) += noise(random);
  return chart;
}

ChartMesh OfUnitArea(ChartMesh chart) {
  double area = 0;
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    const Eigen::Vector3d a = chart.positions.row(chart.triangles(t, 0)),
                          b = chart.positions.row(chart.triangles(t, 1)),
                          c = chart.positions.row(chart.triangles(t, 2));
    area += (b - a).cross(c - a).norm() / 2;
  }
  chart.positions /= std::sqrt(area);
  return chart;
}

TEST(CoarseChart, KeepsVerticesWhereTheyAreAndLeadsBackToThem) {
  const ChartMesh chart = OfUnitArea(SphereCap(30, 1.0));
  const CoarseChart coarse(chart, 450);
  EXPECT_LE(coarse.Mesh().triangles.rows(), 450);
  ASSERT_EQ(coarse.SourceVertices().size(), static_cast<size_t>(coarse.Mesh().positions.rows()));
  for (Eigen::Index v = 0; v < coarse.Mesh().positions.rows(); ++v)
    EXPECT_EQ(coarse.Mesh().positions.row(v), chart.positions.row(coarse.SourceVertices()[v]));
  for (size_t h = 0; h < coarse.Opposite().size(); ++h) {
    const int o = coarse.Opposite()[h];
    if (o >= 0) {
      EXPECT_EQ(coarse.Opposite()[static_cast<size_t>(o)], static_cast<int>(h));
    }
  }
  const Flattening flat = Flatten(coarse.Mesh());
  ASSERT_TRUE(flat.ok) << flat.why;
  const std::optional<PlanePoints> uv = coarse.Continued(flat.uv, {});
  ASSERT_TRUE(uv.has_value());
  EXPECT_EQ(MeasureStretch(chart, ToPoints(*uv, 1)).FlippedOrDegenerate(), 0);
  for (Eigen::Index v = 0; v < flat.uv.rows(); ++v)
    EXPECT_EQ((*uv)[coarse.SourceVertices()[v]], Complex(flat.uv(v, 0), flat.uv(v, 1)));
}

TEST(CoarserCharts, OfChartsForTrialsTellWhatTheyAreOf) {
  const ChartMesh chart = OfUnitArea(SphereCap(260, 1.0));
  ASSERT_GT(chart.triangles.rows(), 120000) << "so that a quarter of it is large, too";
  CoarserCharts coarser(Normalized(chart));
  const FewTriangles &last = coarser.LastQuarter({}), &few = coarser.ForTrials({});
  EXPECT_LE(last.mesh.triangles.rows(), chart.triangles.rows() / 16);
  EXPECT_LE(few.mesh.triangles.rows(), 8000);
  EXPECT_LE(few.mesh.triangles.rows(), last.mesh.triangles.rows());
  const double scale = Normalized(chart).scale;
  for (const FewTriangles* made : {&last, &few}) {
    ASSERT_EQ(made->source_vertex.size(), static_cast<size_t>(made->mesh.positions.rows()));
    ASSERT_EQ(made->source_face.size(), static_cast<size_t>(made->mesh.triangles.rows()));
    const Eigen::RowVector3d offset =
        chart.positions.row(made->source_vertex[0]) - scale * made->mesh.positions.row(0);
    for (Eigen::Index v = 0; v < made->mesh.positions.rows(); ++v)
      EXPECT_LT((chart.positions.row(made->source_vertex[static_cast<size_t>(v)]) - offset -
                 scale * made->mesh.positions.row(v))
                    .norm(),
                1e-3);
  }
}

TEST(CoarseChart, ContinuesMapsOfNoisyChartsWithoutFlips) {
  for (const double noise : {0.0, 0.003, 0.01, 0.03}) {  // edges are about 0.05 long
    const ChartMesh chart = OfUnitArea(Noisy(SphereCap(40, 1.2), noise));
    const CoarseChart coarse(chart, 800);
    const Flattening flat = Flatten(coarse.Mesh());
    ASSERT_TRUE(flat.ok) << flat.why;
    const std::optional<PlanePoints> uv = coarse.Continued(flat.uv, {});
    ASSERT_TRUE(uv.has_value()) << noise;
    EXPECT_EQ(MeasureStretch(chart, ToPoints(*uv, 1)).FlippedOrDegenerate(), 0) << noise;
  }
}

TEST(VertexSweeps, EvenOutTakesNoiseOutOfAMapAndFlipsNothing) {
  const ChartMesh chart = OfUnitArea(GridChart(20, 20, SaddlePoint));
  FlattenOptions options;
  options.linf_finish = false;
  const Flattening flat = Flatten(chart, options);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.008, 0.008);  // edges are about 0.05 long
  PlanePoints uv = ToPlanePoints(flat.uv);
  for (Complex& z : uv) z += Complex(shift(random), shift(random));
  const StretchFigures before = MeasureStretch(chart, ToPoints(uv, 1));
  ASSERT_EQ(before.FlippedOrDegenerate(), 0);
  const RestShapes shapes = RestShapesOf(chart);
  VertexSweeps(static_cast<int>(uv.size()), chart.triangles, shapes).EvenOut({}, uv);
  const StretchFigures after = MeasureStretch(chart, ToPoints(uv, 1));
  EXPECT_EQ(after.FlippedOrDegenerate(), 0);
  EXPECT_LT(after.L2() - flat.l2_stretch, 0.05 * (before.L2() - flat.l2_stretch));
}

TEST(VertexSweeps, LowerWorstTakesAwayASpike) {
  const ChartMesh chart = OfUnitArea(GridChart(20, 20, PlanePoint));
  PlanePoints uv = ToPlanePoints(Flatten(chart).uv);
  uv[200] += Complex(0.02, 0.01);
  const double before = MeasureStretch(chart, ToPoints(uv, 1)).Linf();
  const RestShapes shapes = RestShapesOf(chart);
  VertexSweeps(static_cast<int>(uv.size()), chart.triangles, shapes).LowerWorst({}, uv);
  const StretchFigures after = MeasureStretch(chart, ToPoints(uv, 1));
  EXPECT_EQ(after.FlippedOrDegenerate(), 0);
  EXPECT_GT(before, 1.5);
  EXPECT_LT(after.Linf(), 1.1);
}

TEST(LargeChart, DevelopableOnesComeOutWithoutStretch) {
  const auto cylinder = [](double x, double y) -> Eigen::RowVector3d {
    return {std::cos(2 * x), std::sin(2 * x), y};
  };
  for (const ChartMesh& chart :
       {GridChart(kLarge, kLarge, PlanePoint), GridChart(kLarge, kLarge, cylinder)}) {
    ASSERT_TRUE(IsLargeChart(chart));
    const Flattening flat = Flatten(chart);
    ASSERT_TRUE(flat.ok) << flat.why;
    EXPECT_NEAR(flat.l2_stretch, 1, 1e-4);
    EXPECT_NEAR(flat.linf_stretch, 1, 1e-2);
    EXPECT_EQ(MeasureStretch(chart, flat.uv).FlippedOrDegenerate(), 0);
  }
}

// The same shape with fewer triangles is flattened at once: the stretch must be that, but for a little.
TEST(LargeChart, HasTheStretchOfASmallerOneOfItsShape) {
  for (const double opening : {0.5, 1.0, 1.5}) {
    const ChartMesh large = SphereCap(kLarge, opening), small = SphereCap(100, opening);
    ASSERT_TRUE(IsLargeChart(large));
    ASSERT_FALSE(IsLargeChart(small));
    const Flattening a = Flatten(large), b = Flatten(small);
    ASSERT_TRUE(a.ok && b.ok);
    EXPECT_NEAR(a.l2_stretch - 1, b.l2_stretch - 1, 0.05 * (b.l2_stretch - 1)) << opening;
    EXPECT_NEAR(a.linf_stretch - 1, b.linf_stretch - 1, 0.2 * (b.linf_stretch - 1)) << opening;
    const TrialFlattening trial = TrialFlatten(large);
    ASSERT_TRUE(trial.ok);
    EXPECT_NEAR(trial.l2_stretch - 1, b.l2_stretch - 1, 0.1 * (b.l2_stretch - 1)) << opening;
  }
}

TEST(LargeChart, NoiseMakesNoFlipsAndNoSpikes) {
  const ChartMesh chart = Noisy(SphereCap(kLarge, 1.0), 0.002);  // edges are about 0.015 long
  const Flattening flat = Flatten(chart);
  ASSERT_TRUE(flat.ok) << flat.why;
  EXPECT_EQ(MeasureStretch(chart, flat.uv).FlippedOrDegenerate(), 0);
  EXPECT_LT(flat.linf_stretch, 4);
}

TEST(LargeChart, TheTrialKeepsToItsBoundAndUsesItsStart) {
  const ChartMesh chart = SphereCap(kLarge, 1.0);
  const Flattening full = Flatten(chart);
  TrialOptions options;
  options.l2_bound = 1 + 0.5 * (full.l2_stretch - 1);
  EXPECT_TRUE(TrialFlatten(chart, options).rejected);
  options.l2_bound = 1 + 1.2 * (full.l2_stretch - 1);
  EXPECT_TRUE(TrialFlatten(chart, options).ok);
  options.start = &full.uv;
  EXPECT_NEAR(TrialFlatten(chart, options).l2_stretch - 1, full.l2_stretch - 1, 0.05 * (full.l2_stretch - 1));
}

TEST(LargeChart, PollStopsIt) {
  const test::Threads threads(1);  // with more it is polled more or less often, while one waits for another
  const ChartMesh chart = SphereCap(kLarge, 1.0);
  int polls = 0;
  Flatten(chart, {}, [&] { ++polls; });
  EXPECT_GT(polls, 50);
  struct Stop {};
  for (const int at : {1, 2, polls / 2, polls - 1}) {
    int count = 0;
    EXPECT_THROW(Flatten(chart, {},
                         [&] {
                           if (++count == at) throw Stop();
                         }),
                 Stop);
  }
}

}  // namespace
}  // namespace dcharts
