// SPDX-License-Identifier: GPL-3.0-or-later
/// Whole patterns, from a mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/errors.h"
#include "common/union_find.h"
#include "dcharts.h"
#include "pattern/pattern.h"
#include "pattern/regions.h"
#include "pattern_fixture.h"
#include "shapes.h"

namespace dcharts {
namespace {

Pattern PatternOf(const SurfaceData& mesh, Params params) {
  if (!(params.size > 0)) params.size = 300;
  Progress progress;
  return MakePattern(mesh, params, progress).pattern;
}

Params Paper() {
  Params params;
  params.material = PatternMaterial::kPaper;
  return params;
}

// Euler characteristic of the pieces sewn together: corners that seams bring together are one.
int EulerOf(const Pattern& pattern) {
  std::vector<std::vector<int>> base;
  int corners = 0, loops = 0;
  for (const Piece& piece : pattern.pieces) {
    base.emplace_back();
    for (const OutlineLoop& loop : piece.loops) {
      base.back().push_back(corners);
      corners += static_cast<int>(loop.size());
      ++loops;
    }
  }
  UnionFind together(corners);
  int edges = 0;
  for (const Seam& seam : pattern.seams) {
    edges += seam.sides.front().edges;
    std::vector<int> first;
    for (const SeamSide& side : seam.sides) {
      const int size = static_cast<int>(pattern.pieces[side.piece].loops[side.loop].size());
      for (int k = 0; k <= side.edges; ++k) {
        const int along = side.backwards ? side.edges - k : k;
        const int corner = base[side.piece][side.loop] + (side.first + along) % size;
        if (&side == &seam.sides.front())
          first.push_back(corner);
        else
          together.Join(first[k], corner);
      }
    }
  }
  std::set<int> vertices;
  for (int c = 0; c < corners; ++c) vertices.insert(together.Find(c));
  // A piece with holes has the characteristic 2 - loops inside its outline.
  int faces = 0;
  for (const Piece& piece : pattern.pieces) faces += 2 - static_cast<int>(piece.loops.size());
  return static_cast<int>(vertices.size()) - edges + faces;
}

struct Case {
  const char* shape;
  bool paper;
};

void CanBeSewnBackToTheModel(const Pattern& pattern, const shapes::Shape& shape, bool paper) {
  SCOPED_TRACE("sewn back");
  EXPECT_EQ(EulerOf(pattern), shape.facts.euler);
  EXPECT_LT(pattern.largest_ease, paper ? 0.001 : 0.01);
  double area = 0, model = 0;
  for (const Piece& piece : pattern.pieces) {
    area += piece.area;
    model += piece.model_area;
    EXPECT_FALSE(test::OutlinesCross(piece)) << piece.name;
    EXPECT_GT(piece.label_radius, 0);
    EXPECT_TRUE(IsInside(OutlineOf(piece), piece.label_at));
    EXPECT_FALSE(piece.cut.empty());
    double net = 0;
    for (const auto& t : piece.net.triangles)
      net += Orient(piece.net.vertices[t[0]], piece.net.vertices[t[1]], piece.net.vertices[t[2]]) / 2;
    EXPECT_NEAR(net / piece.area, 1, 1e-9);
  }
  EXPECT_NEAR(area / model, 1, paper ? 0.03 : 0.05);
  // At the size asked for.
  double mesh_area = 0;
  for (const auto& f : shape.mesh.faces) {
    const auto at = [&](int k) -> Point3 {
      const auto& v = shape.mesh.vertices[f[k]];
      return {v[0], v[1], v[2]};
    };
    mesh_area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
  }
  // Of a symmetric model one half takes the place of both, and of fabric seams are smoothed.
  EXPECT_NEAR(model / (mesh_area * pattern.scale * pattern.scale), 1, paper ? 0.001 : 0.002);
}

void HasEveryEdgeInASeamAndEveryFaceInAPiece(const Pattern& pattern) {
  SCOPED_TRACE("edges and faces");
  std::map<std::array<int, 2>, int> edges;  // by seam and side
  for (const Piece& piece : pattern.pieces)
    for (const OutlineLoop& loop : piece.loops)
      for (const OutlinePoint& point : loop) ++edges[{point.seam, point.side}];
  for (const Seam& seam : pattern.seams)
    for (size_t k = 0; k < seam.sides.size(); ++k) {
      EXPECT_EQ((edges[{seam.id, static_cast<int>(k)}]), seam.sides[k].edges);
      EXPECT_EQ(seam.sides[k].edges, seam.sides[0].edges);
      EXPECT_EQ(seam.match_points.empty(), seam.IsBorder());
    }
  for (int piece : pattern.piece_of_face) {
    EXPECT_GE(piece, 0);
    EXPECT_LT(piece, static_cast<int>(pattern.pieces.size()));
  }
}

void LiesOnTheSheetWithoutOverlap(const Pattern& pattern, bool paper) {
  SCOPED_TRACE("on the sheet");
  std::vector<Region> placed;
  for (const Piece& piece : pattern.pieces) {
    Polyline line;
    for (const Point2& p : piece.cut.front()) line.push_back(piece.on_sheet(p));
    for (const Region& other : placed) EXPECT_EQ(CommonArea({{line}}, {other}), 0);
    placed.push_back({line});
    for (const Polyline& loop : OutlineOf(piece))
      for (const Point2& p : loop) {
        double nearest = 1e9;
        for (const Polyline& cut : piece.cut)
          for (size_t k = 0; k < cut.size(); ++k)
            nearest = std::min(nearest, DistanceToSegment(p, cut[k], cut[(k + 1) % cut.size()]));
        EXPECT_GT(nearest, paper ? -1 : 6.99);  // the allowance all around
      }
  }
}

class PatternOfShape : public ::testing::TestWithParam<Case> {};

// One test for all three: making the pattern is what takes the time.
TEST_P(PatternOfShape, SewsTogetherAndLiesOnTheSheet) {
  const shapes::Shape shape = shapes::ShapeByName(GetParam().shape);
  const bool paper = GetParam().paper;
  const Pattern pattern = PatternOf(shape.mesh, paper ? Paper() : Params());
  CanBeSewnBackToTheModel(pattern, shape, paper);
  HasEveryEdgeInASeamAndEveryFaceInAPiece(pattern);
  LiesOnTheSheetWithoutOverlap(pattern, paper);
}

INSTANTIATE_TEST_SUITE_P(Shapes, PatternOfShape,
                         ::testing::Values(Case{"cube", false}, Case{"cube", true},
                                           Case{"closed_cylinder", false}, Case{"closed_cylinder", true},
                                           Case{"open_cone", true}, Case{"torus", false},
                                           Case{"spherical_cap", true}, Case{"plush", false},
                                           Case{"cad_part", true}, Case{"plane_with_hole", true},
                                           Case{"two_components", false}),
                         [](const auto& test) {
                           return std::string(test.param.shape) + (test.param.paper ? "_paper" : "_fabric");
                         });

TEST(PatternModel, SaysHowManyPointsEachPieceHas) {
  std::string log;
  Progress progress({}, [&](const std::string& line) { log += line + "\n"; });
  Params params = Paper();
  params.size = 100;
  const Pattern pattern = MakePattern(shapes::Cube(4), params, progress).pattern;
  std::string line = "Points of the outlines:";
  for (const Piece& piece : pattern.pieces)
    line += (piece.id > 0 ? ", " : " ") + piece.name + " " + std::to_string(piece.loops.front().size());
  EXPECT_NE(log.find(line + "."), std::string::npos) << log;
}

TEST(PatternModel, TheSizeIsTheLongestSideInItsUnit) {
  Params params = Paper();
  params.size = 10;
  params.units = LengthUnit::kInch;
  const Pattern pattern = PatternOf(shapes::Grid(10, 5), params);
  ASSERT_EQ(pattern.pieces.size(), 1u);
  EXPECT_NEAR(pattern.pieces[0].area, 254 * 254, 1);
  EXPECT_NEAR(pattern.scale, 254, 1e-9);
}

TEST(PatternModel, WithoutASizeTheMeshIsInTheUnit) {
  SurfaceData mesh = shapes::Grid(10, 10);
  for (auto& v : mesh.vertices)
    for (double& x : v) x *= 120;
  Progress progress;
  EXPECT_NEAR(MakePattern(mesh, Params(), progress).pattern.pieces[0].area, 120 * 120, 1);
}

TEST(PatternModel, RefusesWhatCannotBeMade) {
  Progress progress;
  Params wide;
  wide.size = 40;
  wide.seam_allowance = 99;
  EXPECT_THROW(MakePattern(shapes::Cube(4), wide, progress), Error);
  Params tiny;
  tiny.size = 1e-3;
  EXPECT_THROW(MakePattern(shapes::Cube(4), tiny, progress), Error);
}

TEST(PatternModel, ACubeOfPaperHasRightAngledMountains) {
  const Pattern pattern = PatternOf(shapes::Cube(6), Paper());
  double folds = 0, seams = pattern.total_seam_length;
  for (const Piece& piece : pattern.pieces)
    for (const Fold& fold : piece.folds) {
      EXPECT_TRUE(fold.mountain);
      EXPECT_NEAR(fold.angle_degrees, 90, 0.1);
      for (size_t k = 0; k + 1 < fold.line.size(); ++k) folds += (fold.line[k + 1] - fold.line[k]).norm();
    }
  EXPECT_GT(folds, 0);
  EXPECT_GE(folds + seams, 12 * 300 - 1);  // each of the cube's edges is one or the other
}

TEST(PatternModel, APieceLargerThanThePageIsSplitOnRequest) {
  Params params;
  params.page = PageFormat::kA4;
  params.size = 700;
  const Pattern tiled = PatternOf(shapes::Grid(20, 20), params);
  EXPECT_EQ(tiled.pieces.size(), 1u);
  EXPECT_EQ(tiled.pieces[0].on_page.page, -1);
  params.oversize = Oversize::kSplitPiece;
  const Pattern split = PatternOf(shapes::Grid(20, 20), params);
  EXPECT_GT(split.pieces.size(), 8u);
  for (const Piece& piece : split.pieces) EXPECT_GE(piece.on_page.page, 0);
}

TEST(PatternModel, ABoxOfLargeTrianglesIsSplitToo) {
  Params params = Paper();
  params.page = PageFormat::kA4;
  params.size = 400;
  params.oversize = Oversize::kSplitPiece;
  const Pattern pattern = PatternOf(shapes::Cube(1), params);
  EXPECT_LE(pattern.pieces.size(), 6u * 8);  // a face alone takes two by three pages
  for (const Piece& piece : pattern.pieces) EXPECT_GE(piece.on_page.page, 0);
  EXPECT_EQ(EulerOf(pattern), 2);
}

TEST(PatternModel, PiecesTooSmallToSewAreNamed) {
  const auto warned = [](double size) {
    Params params;
    params.size = size;
    const Pattern pattern = PatternOf(shapes::Bishop(), params);
    const auto is_small = [](const Piece& piece) {  // against three allowances of 7 mm, and one
      return piece.area < 21 * 21 || 2 * piece.label_radius < 7;
    };
    int small = 0;
    for (const Piece& piece : pattern.pieces) small += is_small(piece);
    int named = 0;
    for (const std::string& warning : pattern.warnings)
      if (warning.rfind("Too small to sew", 0) == 0) {
        for (const Piece& piece : pattern.pieces) {
          const std::string number = std::to_string(piece.id + 1);
          bool is_named = false;
          for (const char* end : {" ", ",", "."})
            is_named |= warning.find(" " + number + end) != std::string::npos;
          EXPECT_EQ(is_named, is_small(piece)) << warning << " piece " << number;
          named += is_named;
        }
      }
    EXPECT_EQ(named, small);
    return named;
  };
  EXPECT_GT(warned(35), 0);
  EXPECT_EQ(warned(500), 0);
}

TEST(PatternModel, ANarrowPieceIsNamed) {
  Params params = Paper();
  params.size = 200;
  SurfaceData strip = shapes::Grid(20, 1);
  for (auto& v : strip.vertices) v[1] *= 0.0125;  // 2.5 mm of 200
  const Pattern pattern = PatternOf(strip, params);
  ASSERT_EQ(pattern.pieces.size(), 1u);
  EXPECT_GT(pattern.pieces[0].area, 144);
  const auto& warnings = pattern.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.rfind("Too small to glue with ease: piece 1.", 0) == 0;
  }));
}

TEST(PatternModel, IsTheSameEveryTime) {
  const Pattern a = PatternOf(shapes::Torus(18), Params()), b = PatternOf(shapes::Torus(18), Params());
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (size_t k = 0; k < a.pieces.size(); ++k) {
    EXPECT_EQ(a.pieces[k].cut, b.pieces[k].cut);
    EXPECT_EQ(a.pieces[k].on_sheet.offset, b.pieces[k].on_sheet.offset);
  }
}

}  // namespace
}  // namespace dcharts
