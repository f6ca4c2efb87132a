// SPDX-License-Identifier: GPL-3.0-or-later
/// What is added to pieces: allowances, tabs, folds, rulings, copies, places.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/errors.h"
#include "common/pi.h"
#include "pattern/allowance.h"
#include "pattern/congruence.h"
#include "pattern/folds.h"
#include "pattern/grain.h"
#include "pattern/label_place.h"
#include "pattern/place_pieces.h"
#include "pattern/regions.h"
#include "pattern/tabs.h"
#include "pattern_fixture.h"
#include "shapes.h"

namespace dcharts {
namespace {

using test::AreaOf;
using test::ChartsOf;
using test::FinePattern;
using test::FromAbove;
using test::PatternOfOutlines;
using test::Rectangle;

Polyline Moved(Polyline line, double angle, const Point2& offset, bool mirror = false) {
  for (Point2& p : line) {
    if (mirror) p.x() = -p.x();
    p = Point2(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
               std::sin(angle) * p.x() + std::cos(angle) * p.y()) +
        offset;
  }
  if (mirror) std::reverse(line.begin(), line.end());
  return line;
}

Polyline Hook() { return {{0, 0}, {60, 0}, {60, 20}, {20, 20}, {20, 100}, {0, 100}}; }

void SetLabels(Pattern& pattern) {
  for (Piece& piece : pattern.pieces) {
    const Circle circle = LargestCircle(OutlineOf(piece));
    piece.label_at = circle.middle;
    piece.label_radius = circle.radius;
  }
}

TEST(PatternAllowance, WidensEveryPiece) {
  Pattern pattern = PatternOfOutlines({Rectangle(50, 40), Hook()});
  SetLabels(pattern);
  AddAllowances(7, pattern);
  EXPECT_NEAR(AreaOf(pattern.pieces[0].cut), 64 * 54, 0.1);
  EXPECT_NEAR(AreaOf(pattern.pieces[1].cut), 74 * 34 + 34 * 80, 0.1);
  EXPECT_TRUE(pattern.warnings.empty());
  EXPECT_EQ(pattern.allowance, 7);
}

TEST(PatternAllowance, ZeroLeavesTheNetOutline) {
  Pattern pattern = PatternOfOutlines({Hook()});
  AddAllowances(0, pattern);
  EXPECT_EQ(pattern.pieces[0].cut[0], Hook());
}

TEST(PatternAllowance, TellsOfNarrowPiecesAndRefusesWhatIsWiderThanAll) {
  Pattern pattern = PatternOfOutlines({Rectangle(50, 40), Rectangle(30, 5)});
  SetLabels(pattern);
  AddAllowances(7, pattern);
  ASSERT_EQ(pattern.warnings.size(), 1u);
  EXPECT_NE(pattern.warnings[0].find("piece 2"), std::string::npos);
  EXPECT_THROW(AddAllowances(60, pattern), Error);
}

// The six sides of a cube of 60 mm, cut apart.
Pattern CubeSides() {
  SurfaceData cube = shapes::Cube(2);
  for (auto& v : cube.vertices)
    for (double& x : v) x *= 60;
  FlatCharts charts = ChartsOf(
      cube,
      [](const Point3& p) {
        int d = 0;
        (p - Point3::Constant(30)).cwiseAbs().maxCoeff(&d);
        return 2 * d + (p[d] > 30);
      },
      FromAbove);
  for (int c = 0; c < 6; ++c)
    for (Eigen::Index v = 0; v < charts.charts[c].uv.rows(); ++v) {
      const auto p = charts.charts[c].mesh.positions.row(v);
      const int d = c / 2, a = (d + 1) % 3, b = (d + 2) % 3;
      charts.charts[c].uv.row(v) << (c % 2 ? p[a] : -p[a]), p[b];
    }
  return FinePattern(charts);
}

TEST(PatternTabs, OneSideOfEverySeamHasOneAndNoneLiesOnAnything) {
  Pattern pattern = CubeSides();
  AddTabs(6, {}, pattern);
  EXPECT_TRUE(pattern.warnings.empty());
  std::vector<int> tabs(pattern.seams.size(), 0);
  for (const Piece& piece : pattern.pieces) {
    double tab_area = 0;
    std::vector<Region> before{OutlineOf(piece)};
    for (const Tab& tab : piece.tabs) {
      ++tabs[tab.seam];
      EXPECT_EQ(pattern.seams[tab.seam].sides[tab.side].piece, piece.id);
      const Region region{tab.outline};
      EXPECT_EQ(CommonArea({region}, before), 0);
      tab_area += std::abs(SignedArea(tab.outline));
      before.push_back(region);
    }
    EXPECT_NEAR(AreaOf(piece.cut), 3600 + tab_area, 0.1);
  }
  for (int count : tabs) EXPECT_EQ(count, 1);
}

TEST(PatternTabs, ZeroWidthMakesNone) {
  Pattern pattern = CubeSides();
  AddTabs(0, {}, pattern);
  for (const Piece& piece : pattern.pieces) {
    EXPECT_TRUE(piece.tabs.empty());
    EXPECT_NEAR(AreaOf(piece.cut), 3600, 0.1);
  }
}

TEST(PatternTabs, InADartTheyAreNarrowOrMissingButNeverOverlap) {
  // A disk with a narrow dart: both legs are sides of one seam.
  Polyline outline{{0, 0}};
  for (int k = 0; k <= 40; ++k) {
    const double a = 0.02 + (2 * kPi - 0.04) * k / 40;
    outline.push_back({80 * std::cos(a), 80 * std::sin(a)});
  }
  Pattern pattern = PatternOfOutlines({outline});
  Seam& leg = pattern.seams.front();
  SeamSide other = pattern.seams.back().sides.front();
  other.backwards = true;
  leg.sides.push_back(other);
  pattern.pieces[0].loops[0].back().seam = 0;
  pattern.pieces[0].loops[0].back().side = 1;
  AddTabs(6, {}, pattern);
  EXPECT_TRUE(pattern.pieces[0].tabs.empty());
  EXPECT_EQ(pattern.warnings.size(), 1u);
}

TEST(PatternTabs, ScissorsGetBetweenThem) {
  // Two equal pieces with a right-angled notch, sewn to each other along all edges: in the notch both tabs'
  // ends would be on one line. One edge is too short for a tab.
  const Polyline notched{{0, 0}, {60, 0}, {60, 30}, {30, 30}, {30, 60}, {1, 60}, {0, 60}};
  Pattern pattern = PatternOfOutlines({notched, notched});
  const size_t n = notched.size();
  for (size_t k = 0; k < n; ++k) {
    pattern.seams[k].length = 10;
    pattern.seams[k].sides.push_back(pattern.seams[n + k].sides[0]);
    pattern.pieces[1].loops[0][k].seam = static_cast<int>(k);
    pattern.pieces[1].loops[0][k].side = 1;
  }
  std::swap(pattern.seams[3].sides[0], pattern.seams[3].sides[1]);  // so that it's the same piece's turn
  std::swap(pattern.pieces[0].loops[0][3].side, pattern.pieces[1].loops[0][3].side);
  pattern.seams[5].length = 1;
  pattern.seams.resize(n);
  AddTabs(8, {}, pattern);
  EXPECT_TRUE(pattern.warnings.empty());
  EXPECT_EQ(pattern.pieces[0].tabs.size() + pattern.pieces[1].tabs.size(), n - 1);
  for (const Piece& piece : pattern.pieces) {
    double tab_area = 0;
    for (const Tab& tab : piece.tabs) {
      EXPECT_NE(tab.seam, 5);
      tab_area += std::abs(SignedArea(tab.outline));
      for (const Tab& other : piece.tabs) {
        if (&tab == &other) continue;
        for (const Region& wide : Widened({{tab.outline.rbegin(), tab.outline.rend()}}, 0.1))
          EXPECT_LT(CommonArea({wide}, {{other.outline}}), 0.15);  // what is around a common corner
      }
    }
    EXPECT_NEAR(AreaOf(piece.cut), 2700 + tab_area, 0.1);
  }
}

TEST(PatternTabs, OfManyTeethSomeHaveOne) {
  // Two pieces with a straight side each, 90 mm long, and one of 60 right-angled teeth between them.
  constexpr int kEdges = 60;
  const double leg = 90 / (kEdges * std::sqrt(0.5));  // 2.1 mm
  std::vector<Polyline> outlines(2);
  for (int k = 0; k <= kEdges; ++k) {
    const Point2 tooth(k * leg * std::sqrt(0.5), k % 2 * leg * std::sqrt(0.5));
    outlines[0].push_back(Point2(90, 0) + Point2(-tooth.x(), tooth.y()));
    outlines[1].push_back({tooth.x(), -tooth.y()});
  }
  outlines[0].insert(outlines[0].end(), {{0, -40}, {90, -40}});
  outlines[1].insert(outlines[1].end(), {{90, -40}, {0, -40}});
  std::reverse(outlines[1].begin(), outlines[1].end());
  Pattern pattern = PatternOfOutlines(outlines);
  // All teeth are one seam; of the other side nothing but its room matters.
  Seam seam = pattern.seams[0];
  seam.sides[0].edges = kEdges;
  seam.sides.push_back({1, 0, 2, kEdges, true, seam.sides[0].length});
  pattern.seams = {seam};
  AddTabs(6, {}, pattern);
  size_t tabs = 0;
  for (const Piece& piece : pattern.pieces) tabs += piece.tabs.size();
  EXPECT_GE(tabs, 4u);
  EXPECT_LE(tabs, 12u);
}

// A roof of two halves, each 50 by 100 mm, that bends by `degrees` along x = 50.
FlatCharts Roof(double degrees) {
  SurfaceData mesh = shapes::Grid(10, 10);
  const double slope = degrees * kPi / 180;
  std::vector<Point2> flat;
  for (auto& v : mesh.vertices) {
    const double x = 100 * v[0] - 50;
    flat.push_back({100 * v[0], 100 * v[1]});
    v = {x > 0 ? x * std::cos(slope) : x, 100 * v[1], x > 0 ? -x * std::sin(slope) : 0};
  }
  FlatCharts charts = ChartsOf(
      mesh, [](const Point3&) { return 0; }, FromAbove);
  FlatChart& chart = charts.charts[0];
  for (size_t v = 0; v < chart.model_vertex.size(); ++v)
    chart.uv.row(static_cast<Eigen::Index>(v)) = flat[chart.model_vertex[v]].transpose();
  return charts;
}

TEST(PatternFolds, ARoofHasOneMountainAndUpsideDownAValley) {
  for (const double degrees : {60.0, -40.0}) {
    const FlatCharts charts = Roof(degrees);
    Pattern pattern = FinePattern(charts);
    AddFolds(charts.charts[0], 15, pattern.pieces[0]);
    ASSERT_EQ(pattern.pieces[0].folds.size(), 1u);
    const Fold& fold = pattern.pieces[0].folds[0];
    EXPECT_EQ(fold.mountain, degrees > 0);
    EXPECT_NEAR(fold.angle_degrees, std::abs(degrees), 1e-6);
    ASSERT_EQ(fold.line.size(), 2u);
    EXPECT_NEAR((fold.line[1] - fold.line[0]).norm(), 100, 1e-6);
    for (const Point2& p : fold.line) EXPECT_NEAR(p.x(), 50, 1e-9);
  }
}

TEST(PatternFolds, BendsBelowTheAngleAreNone) {
  const FlatCharts charts = Roof(10);
  Pattern pattern = FinePattern(charts);
  AddFolds(charts.charts[0], 15, pattern.pieces[0]);
  EXPECT_TRUE(pattern.pieces[0].folds.empty());
}

// A sheet of 200 mm with a bump of a height (mm) in its middle.
TEST(PatternFolds, AGentleBumpHasNoCreasesASharpOneHas) {
  for (const double height : {4.0, 15.0}) {
    SurfaceData mesh = shapes::Grid(20, 20);
    for (auto& v : mesh.vertices) {
      for (int d : {0, 1}) v[d] *= 200;
      if (std::abs(v[0] - 100) < 1 && std::abs(v[1] - 100) < 1) v[2] = height;
    }
    const FlatCharts charts = ChartsOf(
        mesh, [](const Point3&) { return 0; }, FromAbove);
    Pattern pattern = FinePattern(charts);
    AddFolds(charts.charts[0], 20, pattern.pieces[0]);
    EXPECT_EQ(pattern.pieces[0].folds.empty(), height < 10) << height;
  }
}

// A part of a tube, its axis at 30 degrees in the flat piece.
FlatCharts Tube(double radius, double angle_around, double length) {
  SurfaceData mesh = shapes::Grid(40, 20);
  const double c = std::cos(kPi / 6), s = std::sin(kPi / 6);
  std::vector<Point2> flat;
  for (auto& v : mesh.vertices) {
    const double angle = angle_around * v[0], along = length * v[1], arc = radius * angle;
    flat.push_back({c * arc - s * along, s * arc + c * along});
    v = {radius * std::sin(angle), along, radius * std::cos(angle)};
  }
  FlatCharts charts = ChartsOf(
      mesh, [](const Point3&) { return 0; }, FromAbove);
  FlatChart& chart = charts.charts[0];
  for (size_t v = 0; v < chart.model_vertex.size(); ++v)
    chart.uv.row(static_cast<Eigen::Index>(v)) = flat[chart.model_vertex[v]].transpose();
  return charts;
}

TEST(PatternRulings, ACylindersRunAlongItsAxis) {
  const FlatCharts charts = Tube(60, 2, 100);
  Pattern pattern = FinePattern(charts);
  AddRulings(charts.charts[0], 15, 10, pattern.pieces[0]);
  const auto& rulings = pattern.pieces[0].rulings;
  ASSERT_GE(rulings.size(), 6u);
  for (const Ruling& ruling : rulings) {
    const Point2 d = (ruling.to - ruling.from).normalized();
    EXPECT_NEAR(std::abs(d.dot(Point2(-std::sin(kPi / 6), std::cos(kPi / 6)))), 1, 0.01);
  }
  Pattern none = FinePattern(Roof(0));
  AddRulings(Roof(0).charts[0], 15, 10, none.pieces[0]);
  EXPECT_TRUE(none.pieces[0].rulings.empty());
}

TEST(PatternRulings, OfAPrismRunFromEndToEnd) {
  // Flat sides of 15 mm, each of triangles that lie askew: up to the ends of the piece.
  const FlatCharts charts = Tube(100, 6, 200);
  Pattern pattern = FinePattern(charts);
  AddRulings(charts.charts[0], 15, 10, pattern.pieces[0]);
  const auto& rulings = pattern.pieces[0].rulings;
  ASSERT_GE(rulings.size(), 20u);
  for (const Ruling& ruling : rulings) EXPECT_GT((ruling.to - ruling.from).norm(), 195);
}

TEST(PatternRulings, AreFartherApartOnALargePiece) {
  const FlatCharts charts = Tube(900, 2, 20000);
  Pattern pattern = FinePattern(charts);
  AddRulings(charts.charts[0], 15, 10, pattern.pieces[0]);
  EXPECT_GE(pattern.pieces[0].rulings.size(), 2u);
  EXPECT_LE(pattern.pieces[0].rulings.size(), 40u);
}

TEST(PatternGrain, RunsAlongTheModelsLongestAxis) {
  SurfaceData mesh = shapes::Grid(4, 4);
  for (auto& v : mesh.vertices) v = {50 * v[0], 0, 90 * v[1]};
  // Laid flat with the height along x.
  const FlatCharts charts = ChartsOf(
      mesh, [](const Point3&) { return 0; }, [](const Point3& p) { return Point2(p.z(), -p.x()); });
  Pattern pattern = FinePattern(charts);
  SetGrain(charts, pattern);
  EXPECT_NEAR(pattern.pieces[0].grain.x(), 1, 1e-9);
}

TEST(PatternCongruence, FindsCopiesAndMirrorImagesHoweverTheyLie) {
  Pattern pattern =
      PatternOfOutlines({Hook(), Rectangle(50, 40), Moved(Hook(), 1.1, {300, 20}),
                         Moved(Hook(), 2.7, {-80, 33}, true), Moved(Rectangle(50, 40), 0.3, {5, 5})});
  FindCongruentPieces(1, pattern);
  const auto& pieces = pattern.pieces;
  EXPECT_EQ(pieces[2].group, 0);
  EXPECT_FALSE(pieces[2].mirrored);
  EXPECT_EQ(pieces[3].group, 0);
  EXPECT_TRUE(pieces[3].mirrored);
  EXPECT_EQ(pieces[4].group, 1);
  EXPECT_FALSE(pieces[4].mirrored);  // its own mirror image: no need to turn it over
  CountCopies(true, pattern);
  EXPECT_EQ(pieces[0].copies, 2);
  EXPECT_EQ(pieces[0].mirror_copies, 1);
  EXPECT_EQ(pieces[1].copies, 2);
  EXPECT_FALSE(pieces[2].drawn);
  CountCopies(false, pattern);
  for (const Piece& piece : pieces) {
    EXPECT_TRUE(piece.drawn);
    EXPECT_EQ(piece.copies, 1);
  }
}

TEST(PatternCongruence, NoiseWithinTheToleranceDoesNotMatter) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  const auto noisy = [&](Polyline line) {
    for (Point2& p : line) p += Point2(noise(random), noise(random));
    return line;
  };
  Pattern pattern = PatternOfOutlines({noisy(Hook()), noisy(Moved(Hook(), 0.7, {10, 0}, true))});
  FindCongruentPieces(1, pattern);
  EXPECT_EQ(pattern.pieces[1].group, 0);
  EXPECT_TRUE(pattern.pieces[1].mirrored);
  FindCongruentPieces(0.05, pattern);
  EXPECT_EQ(pattern.pieces[1].group, 1);
}

TEST(PatternCongruence, OtherShapesOfTheSameAreaAreNoCopies) {
  Pattern pattern = PatternOfOutlines({Rectangle(60, 40), Rectangle(48, 50), Rectangle(30, 80)});
  FindCongruentPieces(2, pattern);
  for (const Piece& piece : pattern.pieces) EXPECT_EQ(piece.group, piece.id);
}

void ExpectApart(const Pattern& pattern, bool on_pages) {
  std::vector<Region> placed;
  std::vector<int> page;
  for (const Piece& piece : pattern.pieces) {
    const PiecePlacement& place = on_pages ? piece.on_page : piece.on_sheet;
    Polyline line;
    for (const Point2& p : piece.cut.front()) line.push_back(place(p));
    placed.push_back({line});
    page.push_back(place.page);
  }
  for (size_t a = 0; a < placed.size(); ++a)
    for (size_t b = 0; b < a; ++b) {
      if (page[a] != page[b] || page[a] < 0) continue;
      EXPECT_EQ(CommonArea({placed[a]}, {placed[b]}), 0);
    }
}

std::vector<Polyline> SomePieces() {
  std::vector<Polyline> pieces;
  for (int k = 0; k < 9; ++k) {
    pieces.push_back(Moved(Hook(), 0.4 * k, {0, 0}, k % 2 == 0));
    pieces.push_back(Rectangle(30 + 10 * k, 25));
  }
  return pieces;
}

TEST(PatternPlaces, ThePiecesLieApartOnANearlySquareSheet) {
  Pattern pattern = PatternOfOutlines(SomePieces());
  PlacePieces(PageFormat::kSingleSheet, true, 4, {}, pattern);
  ExpectApart(pattern, false);
  double area = 0;
  for (const Piece& piece : pattern.pieces) {
    area += SignedArea(piece.cut.front());
    for (const Point2& p : piece.cut.front()) {
      const Point2 at = piece.on_sheet(p);
      EXPECT_GE(at.minCoeff(), kPageMargin - 1e-6);
      EXPECT_LE((at - pattern.sheet_size).maxCoeff(), -kPageMargin + 1e-6);
    }
  }
  EXPECT_GT(area, 0.45 * pattern.sheet_size.x() * pattern.sheet_size.y());
  EXPECT_LT(pattern.sheet_size.maxCoeff() / pattern.sheet_size.minCoeff(), 1.3);
}

TEST(PatternPlaces, OnPagesTheyKeepWithinTheMargins) {
  Pattern pattern = PatternOfOutlines(SomePieces());
  PlacePieces(PageFormat::kA4, true, 4, {}, pattern);
  ExpectApart(pattern, true);
  EXPECT_EQ(pattern.page_size, Point2(210, 297));
  EXPECT_GE(pattern.page_count, 1);
  EXPECT_LE(pattern.page_count, 3);
  for (const Piece& piece : pattern.pieces) {
    ASSERT_GE(piece.on_page.page, 0);
    ASSERT_LT(piece.on_page.page, pattern.page_count);
    for (const Point2& p : piece.cut.front()) {
      const Point2 at = piece.on_page(p);
      EXPECT_GE(at.minCoeff(), kPageMargin - 1e-6);
      EXPECT_LE((at - pattern.page_size).maxCoeff(), -kPageMargin + 1e-6);
    }
  }
}

TEST(PatternPlaces, APieceLargerThanThePageIsLeftForTiles) {
  Pattern pattern = PatternOfOutlines({Rectangle(500, 300), Rectangle(50, 30)});
  PlacePieces(PageFormat::kA4, true, 4, {}, pattern);
  EXPECT_EQ(pattern.pieces[0].on_page.page, -1);
  EXPECT_EQ(pattern.pieces[1].on_page.page, 0);
  EXPECT_EQ(pattern.page_count, 1);
}

TEST(PatternPlaces, PiecesKeepTheirDirectionWhenTheyMayNotBeTurned) {
  Pattern pattern = PatternOfOutlines(SomePieces());
  PlacePieces(PageFormat::kA3, false, 4, {}, pattern);
  for (const Piece& piece : pattern.pieces) {
    EXPECT_EQ(piece.on_sheet.angle, 0);
    EXPECT_EQ(piece.on_page.angle, 0);
  }
  ExpectApart(pattern, false);
  ExpectApart(pattern, true);
}

}  // namespace
}  // namespace dcharts
