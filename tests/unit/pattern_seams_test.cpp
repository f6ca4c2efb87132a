// SPDX-License-Identifier: GPL-3.0-or-later
/// Seams: chained, made equally long, simplified on both sides at once, with match points.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "pattern/equal_outlines.h"
#include "pattern/equal_seams.h"
#include "pattern/match_points.h"
#include "pattern_checks.h"
#include "pattern_fixture.h"
#include "planar/flatten.h"
#include "shapes.h"

namespace dcharts {
namespace {

using test::AllVertices;
using test::ChartsOf;
using test::FinePattern;
using test::FromAbove;

SurfaceData Scaled(SurfaceData mesh, double factor) {
  for (auto& v : mesh.vertices)
    for (double& x : v) x *= factor;
  return mesh;
}

int LeftOrRight(const Point3& p) { return p.x() < 50 ? 0 : 1; }

// A square of 100 mm in two halves.
FlatCharts TwoHalves() { return ChartsOf(Scaled(shapes::Grid(20, 20), 100), LeftOrRight, FromAbove); }

// The same, the seam between the halves a wave of 5 mm.
FlatCharts WavyHalves() {
  FlatCharts charts = TwoHalves();
  for (FlatChart& chart : charts.charts)
    for (Eigen::Index v = 0; v < chart.uv.rows(); ++v) {
      const double x = chart.uv(v, 0), y = chart.uv(v, 1);
      const double moved = x + 5 * std::sin(y / 8) * (1 - std::abs(x - 50) / 50);
      chart.uv(v, 0) = chart.mesh.positions(v, 0) = moved;
    }
  return charts;
}

TEST(PatternSeamGraph, ASquareInTwoHalvesHasOneSeamAndTwoBorders) {
  const SeamGraph graph = SeamsOf(TwoHalves());
  ASSERT_EQ(graph.seams.size(), 3u);
  int seams = 0;
  double border = 0;
  for (const FineSeam& seam : graph.seams) {
    EXPECT_FALSE(seam.closed);
    if (seam.sides.size() == 1) border += seam.Length();
    if (seam.sides.size() != 2) continue;
    ++seams;
    EXPECT_NEAR(seam.Length(), 100, 1e-9);
    EXPECT_NE(seam.sides[0].backwards, seam.sides[1].backwards);
  }
  EXPECT_EQ(seams, 1);
  EXPECT_NEAR(border, 400, 1e-9);
}

TEST(PatternSeamGraph, AClosedSeamIsFoundOnce) {
  const FlatCharts charts = ChartsOf(
      Scaled(shapes::Disk(12), 50), [](const Point3& p) { return p.norm() < 25 ? 0 : 1; }, FromAbove);
  const SeamGraph graph = SeamsOf(charts);
  ASSERT_EQ(graph.seams.size(), 2u);
  for (const FineSeam& seam : graph.seams) EXPECT_TRUE(seam.closed);
}

TEST(PatternSeamGraph, EveryBoundaryEdgeIsInOneSeam) {
  const FlatCharts charts = ChartsOf(
      Scaled(shapes::Cube(4), 30),
      [](const Point3& p) {
        int d = 0;
        (p - Point3::Constant(15)).cwiseAbs().maxCoeff(&d);
        return 2 * d + (p[d] > 15);
      },
      FromAbove);
  ASSERT_EQ(charts.charts.size(), 6u);
  const SeamGraph graph = SeamsOf(charts);
  EXPECT_EQ(graph.seams.size(), 12u);
  for (size_t c = 0; c < 6; ++c) {
    std::set<std::array<int, 3>> seen;
    int count = 0;
    for (const SeamPlace& place : graph.places[c])
      if (place.seam >= 0) {
        ++count;
        seen.insert({place.seam, place.side, place.edge});
      }
    EXPECT_EQ(count, 16);
    EXPECT_EQ(seen.size(), 16u);
  }
}

TEST(PatternPieces, KnowTheirLoopsSidesAndAreas) {
  const Pattern pattern = FinePattern(TwoHalves());
  ASSERT_EQ(pattern.pieces.size(), 2u);
  for (const Piece& piece : pattern.pieces) {
    ASSERT_EQ(piece.loops.size(), 1u);
    EXPECT_EQ(piece.loops[0].size(), 60u);
    EXPECT_NEAR(piece.area, 5000, 1e-6);
    EXPECT_NEAR(piece.model_area, 5000, 1e-6);
  }
  for (const Seam& seam : pattern.seams) {
    EXPECT_NEAR(seam.ease, 0, 1e-12);
    for (const SeamSide& side : seam.sides) EXPECT_NEAR(side.length, seam.length, 1e-9);
  }
  EXPECT_NEAR(pattern.total_seam_length, 100, 1e-9);
}

TEST(PatternPieces, SidesGoAlongTheSameLineOfTheModel) {
  const Pattern pattern = FinePattern(WavyHalves());
  for (const Seam& seam : pattern.seams) {
    if (seam.sides.size() != 2) continue;
    const Polyline a = SideOf(pattern, seam.sides[0]), b = SideOf(pattern, seam.sides[1]);
    ASSERT_EQ(a.size(), b.size());
    for (size_t k = 0; k < a.size(); ++k) EXPECT_NEAR((a[k] - b[k]).norm(), 0, 1e-9);
  }
}

TEST(PatternSimplify, AStraightOutlineKeepsItsCorners) {
  const FlatCharts charts = TwoHalves();
  const SeamGraph graph = SeamsOf(charts);
  const Pattern pattern = BuildPieces(charts, graph, SimplifySeams(charts, graph, {0.1, 0.01}, {}));
  for (const Piece& piece : pattern.pieces) {
    EXPECT_EQ(piece.loops[0].size(), 4u);
    EXPECT_NEAR(piece.area, 5000, 1e-6);
  }
}

TEST(PatternSimplify, BothSidesKeepTheSamePointsWithinTheTolerance) {
  const FlatCharts charts = WavyHalves();
  const SeamGraph graph = SeamsOf(charts);
  size_t before = 1000;
  for (const double tolerance : {0.1, 0.5, 2.0, 12.0}) {
    const Pattern pattern = BuildPieces(charts, graph, SimplifySeams(charts, graph, {tolerance, 0.5}, {}));
    const Pattern fine = FinePattern(charts);
    for (size_t s = 0; s < pattern.seams.size(); ++s) {
      const Seam& seam = pattern.seams[s];
      for (size_t k = 0; k < seam.sides.size(); ++k) {
        EXPECT_EQ(seam.sides[k].edges, seam.sides[0].edges);
        const Polyline simple = SideOf(pattern, seam.sides[k]);
        for (const Point2& p : SideOf(fine, fine.seams[s].sides[k])) {
          double nearest = 1e9;
          for (size_t i = 0; i + 1 < simple.size(); ++i)
            nearest = std::min(nearest, DistanceToSegment(p, simple[i], simple[i + 1]));
          EXPECT_LE(nearest, tolerance + 1e-9);
        }
      }
    }
    const size_t points = pattern.pieces[0].loops[0].size();
    EXPECT_LE(points, before);
    before = points;
    for (const Piece& piece : pattern.pieces) EXPECT_FALSE(test::OutlinesCross(piece));
  }
  EXPECT_EQ(before, 4u);  // higher than the wave
}

TEST(PatternSimplify, ATightEaseKeepsMorePoints) {
  FlatCharts charts = WavyHalves();
  // One side straight, the other wavy: their chords differ.
  for (Eigen::Index v = 0; v < charts.charts[1].uv.rows(); ++v) {
    double& x = charts.charts[1].uv(v, 0);
    if (charts.charts[1].mesh.positions(v, 0) == x) x += 30;
  }
  for (Eigen::Index v = 0; v < charts.charts[0].uv.rows(); ++v) charts.charts[0].uv(v, 1) *= 1.02;
  const SeamGraph graph = SeamsOf(charts);
  const auto most_ease = [&](double ease) {
    const Pattern pattern = BuildPieces(charts, graph, SimplifySeams(charts, graph, {3, ease}, {}));
    return pattern.pieces[0].loops[0].size();
  };
  EXPECT_GT(most_ease(0.001), most_ease(0.1));
}

TEST(PatternSimplify, APieceNarrowerThanTheToleranceDoesNotCrossItself) {
  SurfaceData strip = shapes::Grid(60, 2);
  for (auto& v : strip.vertices) {
    v[0] *= 100;
    v[1] = v[1] + 4 * std::sin(v[0] / 5);
  }
  const FlatCharts charts = ChartsOf(
      strip, [](const Point3&) { return 0; }, FromAbove);
  const SeamGraph graph = SeamsOf(charts);
  const Pattern pattern = BuildPieces(charts, graph, SimplifySeams(charts, graph, {5, 1}, {}));
  EXPECT_FALSE(test::OutlinesCross(pattern.pieces[0]));
  EXPECT_GE(pattern.pieces[0].loops[0].size(), 3u);
  EXPECT_GT(pattern.pieces[0].area, 0);
}

FlatCharts CapLaidFlat(double angle, FlattenMethod method) {
  FlatCharts charts = ChartsOf(
      Scaled(shapes::SphericalCap(14, angle), 100), [](const Point3&) { return 0; }, FromAbove);
  FlattenOptions options;
  options.method = method;
  charts.charts[0].uv = Flatten(charts.charts[0].mesh, options).uv;
  return charts;
}

TEST(PatternEqualSeams, BoundaryEdgesGetTheirLengthOnTheModel) {
  for (const KeepInside keep : {KeepInside::kAngles, KeepInside::kLengths}) {
    FlatCharts charts = CapLaidFlat(1.2, FlattenMethod::kConformal);
    FlatChart& chart = charts.charts[0];
    const std::vector<int> boundary = test::BoundaryEdgesOf(charts, 0);
    const EqualSeams result = EqualizeSeams(boundary, keep, {}, chart);
    EXPECT_TRUE(result.whole);
    EXPECT_LT(result.worst, 1e-4);
    for (int h : boundary) {
      const int a = StartOf(chart, h), b = EndOf(chart, h);
      const double model = (chart.mesh.positions.row(a) - chart.mesh.positions.row(b)).norm();
      EXPECT_NEAR((chart.uv.row(a) - chart.uv.row(b)).norm() / model, 1, 1e-4);
    }
  }
}

// A needle's point between two folded faces, from the fuzzer: with equal seams the outline lay upside down,
// and nowhere crossed itself.
TEST(PatternEqualSeams, AnOutlineIsNotTurnedOver) {
  FlatChart chart;
  chart.mesh.positions.resize(5, 3);
  chart.mesh.positions << -2.02878, 2.79859, 5.11485, 6.94079, 4.6398, 3.67285, -2.02878, 4.94584, 13.8936,
      -2.02878, -0.171323, -7.02732, 5.39673, -1.17153, 0.554394;
  chart.mesh.triangles.resize(4, 3);
  chart.mesh.triangles << 0, 1, 2, 0, 2, 3, 3, 2, 4, 1, 4, 2;
  chart.uv.resize(5, 2);
  chart.uv << 3.04457, 0.00436043, -5.55249, 4.07424, 0, 0, 23.4627, 0, -5.00047, -10.7259;
  const std::vector<int> boundary = {0, 5, 8, 9};
  EXPECT_FALSE(EqualizeSeams(boundary, KeepInside::kAngles, {}, chart).whole);
  double area = 0;
  for (Eigen::Index t = 0; t < chart.mesh.triangles.rows(); ++t) {
    const auto corner = [&](int k) -> Point2 { return chart.uv.row(chart.mesh.triangles(t, k)).transpose(); };
    area += Orient(corner(0), corner(1), corner(2)) / 2;
  }
  EXPECT_GT(area, 0);
  EXPECT_TRUE(CrossingEdges(chart, boundary).empty());
}

TEST(PatternEqualSeams, AFlatChartStaysAsItIs) {
  FlatCharts charts = TwoHalves();
  const Points2 before = charts.charts[0].uv;
  EqualizeSeams(test::BoundaryEdgesOf(charts, 0), KeepInside::kAngles, {}, charts.charts[0]);
  EXPECT_LT((charts.charts[0].uv - before).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(PatternEqualOutlines, MakesUnequalSidesEqual) {
  FlatCharts charts = TwoHalves();
  for (Eigen::Index v = 0; v < charts.charts[0].uv.rows(); ++v) charts.charts[0].uv(v, 1) *= 1.01;
  const SeamGraph graph = SeamsOf(charts);
  Pattern pattern = BuildPieces(charts, graph, SimplifySeams(charts, graph, {0.5, 0.1}, {}));
  EXPECT_GT(pattern.largest_ease, 0.009);
  EqualizeOutlines(2, pattern);
  EXPECT_LT(pattern.largest_ease, 1e-6);
}

TEST(PatternEqualOutlines, ANeedleIsNotTurnedOver) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    SurfaceData mesh;
    const double height = std::pow(10, -6 + 5 * anywhere(random));
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {anywhere(random), height, 0}, {anywhere(random), 1, 0}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}};
    FlatCharts charts = test::ChartsOf(
        mesh, [](const Point3& p) { return p.y() < 0.1 ? 0 : 1; }, test::FromAbove);
    for (FlatChart& chart : charts.charts)
      for (Eigen::Index v = 0; v < chart.uv.rows(); ++v) chart.uv(v, 0) *= 1 + anywhere(random);
    const SeamGraph graph = SeamsOf(charts);
    Pattern pattern = BuildPieces(charts, graph, test::AllVertices(graph));
    std::vector<bool> was_sound;
    for (const Piece& piece : pattern.pieces) was_sound.push_back(piece.area > 0);
    EqualizeOutlines(1, pattern);
    for (const Piece& piece : pattern.pieces)
      EXPECT_TRUE(piece.area > 0 || !was_sound[piece.id]) << trial << " " << piece.name << " " << piece.area;
  }
}

// Two points of an hourglass are at the same place; the pieces beside it want both to move inwards.
TEST(PatternEqualOutlines, AnOutlineThatTouchesItselfDoesNotCrossItself) {
  const auto piece_of = [](int id, const Polyline& points, const std::vector<int>& seams) {
    Piece piece;
    piece.id = id;
    OutlineLoop loop;
    for (size_t k = 0; k < points.size(); ++k) {
      OutlinePoint point;
      point.at = points[k];
      point.seam = seams[k];
      loop.push_back(point);
    }
    piece.loops = {loop};
    return piece;
  };
  Pattern pattern;
  pattern.pieces = {
      piece_of(0, {{0, 0}, {10, 0}, {5, 5}, {10, 10}, {0, 10}, {5, 5}}, {2, 0, 0, 3, 1, 1}),
      piece_of(1, {{10, 0}, {20, 5}, {10, 10}, {4, 5}}, {4, 5, 0, 0}),
      piece_of(2, {{0, 0}, {6, 5}, {0, 10}, {-10, 5}}, {1, 1, 6, 7}),
  };
  const auto seam_of = [](int id, const std::vector<SeamSide>& sides) {
    Seam seam;
    seam.id = id;
    seam.sides = sides;
    return seam;
  };
  pattern.seams = {seam_of(0, {{0, 0, 1, 2, false, 0}, {1, 0, 2, 2, true, 0}}),
                   seam_of(1, {{0, 0, 4, 2, false, 0}, {2, 0, 0, 2, true, 0}}),
                   seam_of(2, {{0, 0, 0, 1, false, 0}}),
                   seam_of(3, {{0, 0, 3, 1, false, 0}}),
                   seam_of(4, {{1, 0, 0, 1, false, 0}}),
                   seam_of(5, {{1, 0, 1, 1, false, 0}}),
                   seam_of(6, {{2, 0, 2, 1, false, 0}}),
                   seam_of(7, {{2, 0, 3, 1, false, 0}})};
  EqualizeOutlines(2, pattern);
  for (const Piece& piece : pattern.pieces) {
    EXPECT_FALSE(test::OutlinesCross(OutlineOf(piece))) << piece.id;
    EXPECT_GT(piece.area, 0);
  }
}

TEST(PatternMatchPoints, AreAtEqualArcLengthOnBothSides) {
  FlatCharts charts = WavyHalves();
  const SeamGraph graph = SeamsOf(charts);
  Pattern pattern = BuildPieces(charts, graph, SimplifySeams(charts, graph, {1, 0.1}, {}));
  AddMatchPoints(pattern);
  std::set<int> numbers;
  int points = 0;
  for (const Seam& seam : pattern.seams) {
    if (seam.IsBorder()) {
      EXPECT_TRUE(seam.match_points.empty());
      continue;
    }
    ASSERT_GE(seam.match_points.size(), 2u);
    for (size_t k = 0; k < seam.match_points.size(); ++k) {
      const MatchPoint& point = seam.match_points[k];
      EXPECT_EQ(point.kind, k > 0 ? NotchKind::kSingle : NotchKind::kDouble);
      EXPECT_GT(point.arc, 0);
      EXPECT_LT(point.arc, seam.length);
      numbers.insert(point.number);
      ++points;
      // Both halves lie as they did on the square, so the two places are one.
      ASSERT_EQ(point.at.size(), 2u);
      EXPECT_NEAR((point.at[0] - point.at[1]).norm(), 0, 1e-6);
      EXPECT_NEAR((point.outward[0] + point.outward[1]).norm(), 0, 1e-6);
    }
  }
  EXPECT_EQ(static_cast<int>(numbers.size()), points);
}

// The sides of a cube, each a piece.
Pattern SixSides(double edge) {
  return FinePattern(ChartsOf(
      Scaled(shapes::Cube(4), edge),
      [edge](const Point3& p) {
        int d = 0;
        (p - Point3::Constant(edge / 2)).cwiseAbs().maxCoeff(&d);
        return 2 * d + (p[d] > edge / 2);
      },
      FromAbove));
}

TEST(PatternSewingOrder, NumbersEverySeamOnceAndLeavesTheLongestOfSmallOnesOpen) {
  Pattern pattern = SixSides(30);
  pattern.seams[7].length += 1;
  SetSewingOrder(pattern);
  std::set<int> orders;
  for (const Seam& seam : pattern.seams) orders.insert(seam.order);
  EXPECT_EQ(orders.size(), 12u);
  EXPECT_EQ(*orders.begin(), 1);
  EXPECT_EQ(*orders.rbegin(), 12);
  EXPECT_TRUE(pattern.seams[7].opening);
  EXPECT_EQ(pattern.seams[7].order, 12);
}

TEST(PatternSewingOrder, LeavesTheShortestOpenThatAHandGoesThrough) {
  Pattern pattern = SixSides(200);
  pattern.seams[3].length = 79;
  pattern.seams[5].length = 81;
  pattern.seams[9].length = 500;
  SetSewingOrder(pattern);
  for (const Seam& seam : pattern.seams) EXPECT_EQ(seam.opening, seam.id == 5) << seam.id;
  EXPECT_EQ(pattern.seams[5].order, 12);
}

}  // namespace
}  // namespace dcharts
