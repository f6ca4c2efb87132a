// SPDX-License-Identifier: GPL-3.0-or-later
/// The drawings of whole models: nothing on a sheet overlaps.
#include <algorithm>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dcharts.h"
#include "pattern/drawing/assembly.h"
#include "pattern/drawing/flat_layer.h"
#include "pattern/drawing/label_space.h"
#include "pattern/drawing/pdf_pages.h"
#include "pattern/drawing/sheet.h"
#include "pattern_by_hand.h"
#include "shapes.h"
#include "planar/polygon.h"

namespace dcharts {
namespace {

struct Case {
  const char* shape;
  PatternMaterial material;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.shape; }

using Corners = std::vector<Point2>;

Corners CornersOf(const Text& text) {
  const auto corners = BoxOf(text).Corners();
  return {corners.begin(), corners.end()};
}

std::vector<Corners> SegmentsOf(const Line& line) {
  std::vector<Corners> segments;
  for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
    segments.push_back({line.points[i], line.points[(i + 1) % line.points.size()]});
  return segments;
}

// The first thing that lies on a text.
std::string OverlapOnSheet(const Drawing& drawing) {
  std::vector<std::pair<std::string, Corners>> texts;
  for (const Group& group : drawing.groups)
    for (const Text& text : group.texts) texts.emplace_back(group.name + ": " + text.text, CornersOf(text));
  for (std::size_t a = 0; a < texts.size(); ++a)
    for (std::size_t b = a + 1; b < texts.size(); ++b)
      if (Overlap(texts[a].second, texts[b].second)) return texts[a].first + " and " + texts[b].first;
  for (const Group& group : drawing.groups)
    for (const Line& line : group.lines)
      for (const Corners& segment : SegmentsOf(line))
        for (const auto& [name, corners] : texts)
          if (Overlap(corners, segment)) return name + " and a line of " + group.name;
  return "";
}

struct Made {
  SurfaceData mesh;
  Pattern pattern;  // with an A4 page; its sheet is the same on any page
};

// Made once for all tests.
const Made& PatternOf(const Case& c) {
  static std::map<std::pair<std::string, PatternMaterial>, Made> all;
  const auto [made, is_new] = all.try_emplace({c.shape, c.material});
  if (is_new) {
    Params params;
    params.material = c.material;
    params.size = 200;
    params.page = PageFormat::kA4;
    Progress progress;
    made->second.mesh = shapes::ShapeByName(c.shape).mesh;
    made->second.pattern = MakePattern(made->second.mesh, params, progress).pattern;
  }
  return made->second;
}

class PatternSheet : public ::testing::TestWithParam<Case> {};

TEST_P(PatternSheet, NothingOverlaps) {
  const auto& [mesh, pattern] = PatternOf(GetParam());
  Draft draft{pattern, mesh, "test"};
  const Drawing sheet = SheetOf(draft);
  EXPECT_EQ(OverlapOnSheet(sheet), "");
  EXPECT_TRUE(draft.unplaced.empty()) << draft.unplaced.front();
  for (const Drawing& page : AssemblyPages(draft, {210, 297}, 10)) EXPECT_EQ(OverlapOnSheet(page), "");
}

TEST_P(PatternSheet, ALabelIsInItsPieceOrHasALeader) {
  const auto& [mesh, pattern] = PatternOf(GetParam());
  Draft draft{pattern, mesh, "test"};
  for (const Group& group : SheetOf(draft).groups) {
    if (!group.is_piece) continue;
    std::vector<Polyline> cut;
    std::size_t leaders = 0, outside = 0;
    for (const Line& line : group.lines) {
      if (line.mark == Mark::kCut) cut.push_back(line.points);
      leaders += line.mark == Mark::kLeader;
    }
    for (const Text& text : group.texts) outside += !IsInside(cut, text.at);
    const bool name_is_outside = !IsInside(cut, group.texts[0].at);  // three lines of text with one leader
    EXPECT_LE(outside, leaders + (name_is_outside ? 2 : 0)) << group.name;
  }
}

TEST_P(PatternSheet, EveryDrawnPieceIsOnOnePageOrTiledAndInTheLayer) {
  const auto& [mesh, pattern] = PatternOf(GetParam());
  Draft draft{pattern, mesh, "test"};
  std::map<std::string, int> times;
  for (const Page& page : PdfPages(draft))
    for (const PageView& view : page.views)
      for (const Group& group : view.drawing->groups) times[group.id] += group.is_piece;
  const FlatLayer layer = LayerOf(pattern);
  for (const Piece& piece : pattern.pieces) {
    const int found = times["piece-" + std::to_string(piece.id + 1)];
    if (piece.on_page.page >= 0)
      EXPECT_EQ(found, 1) << piece.name;
    else
      EXPECT_GE(found, 2) << piece.name;
    EXPECT_EQ(std::count(layer.piece.begin(), layer.piece.end(), piece.id),
              static_cast<std::ptrdiff_t>(piece.net.triangles.size()));
  }
}

// How many texts and leaders the first piece gets for its folds: `rows` lines of `length` mm, 1 mm apart.
std::pair<std::size_t, std::size_t> TextsAndLeadersForFolds(int rows, double length, double angle_step) {
  Pattern pattern = Cushions({60}, 0);
  pattern.material = PatternMaterial::kPaper;
  const SurfaceData mesh = shapes::Cube(1);
  const auto count = [&] {
    Draft draft{pattern, mesh, "test"};
    for (const Group& group : SheetOf(draft).groups) {
      if (!group.is_piece) continue;
      std::size_t leaders = 0;
      for (const Line& line : group.lines) leaders += line.mark == Mark::kLeader;
      return std::make_pair(group.texts.size(), leaders);
    }
    return std::make_pair(std::size_t{0}, std::size_t{0});
  };
  const auto before = count();
  for (int k = 0; k < rows; ++k) {
    Fold fold;
    fold.line = {{-length / 2, 20.0 + k}, {length / 2, 20.0 + k}};
    fold.angle_degrees = 30 + k * angle_step;
    pattern.pieces[0].folds.push_back(fold);
  }
  const auto after = count();
  return {after.first - before.first, after.second - before.second};
}

TEST(PatternLabels, FoldsOfAboutOneAngleAreLabelledOnce) {
  EXPECT_EQ(TextsAndLeadersForFolds(9, 20, 0.3).first, 1u);
  EXPECT_GT(TextsAndLeadersForFolds(9, 20, 4).first, 2u);
}

TEST(PatternLabels, ShortFoldsGetNoLeaders) {
  EXPECT_EQ(TextsAndLeadersForFolds(9, 6, 4).second, 0u);
  EXPECT_GT(TextsAndLeadersForFolds(9, 30, 4).second, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, PatternSheet,
    ::testing::Values(Case{"cube", PatternMaterial::kFabric}, Case{"cube", PatternMaterial::kPaper},
                      Case{"closed_cylinder", PatternMaterial::kFabric},
                      Case{"open_cone", PatternMaterial::kPaper}, Case{"torus", PatternMaterial::kFabric},
                      Case{"plush", PatternMaterial::kFabric}, Case{"cad_part", PatternMaterial::kPaper},
                      Case{"two_components", PatternMaterial::kFabric}),
    [](const auto& test) {
      return std::string(test.param.shape) +
             (test.param.material == PatternMaterial::kPaper ? "_paper" : "_fabric");
    });

}  // namespace
}  // namespace dcharts
