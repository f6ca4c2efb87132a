// SPDX-License-Identifier: GPL-3.0-or-later
/// What is on a drawing, and that the files hold it. The files are read back by other programs in tests/host.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>

#include <gtest/gtest.h>

#include "common/errors.h"
#include "pattern/drawing/dxf_writer.h"
#include "pattern/drawing/label_space.h"
#include "pattern/drawing/number_text.h"
#include "pattern/drawing/pdf_writer.h"
#include "pattern/drawing/sheet.h"
#include "pattern/drawing/svg_writer.h"
#include "pattern/drawing/text_box.h"
#include "pattern/drawing/tiles.h"
#include "pattern/drawing/write_pattern.h"
#include "pattern_by_hand.h"
#include "planar/polygon.h"

namespace dcharts {
namespace {

Drawing DrawingOf(const Pattern& pattern, std::vector<std::string>* unplaced = nullptr) {
  const SurfaceData no_mesh;
  Draft draft{pattern, no_mesh, "Cushions"};
  Drawing drawing = SheetOf(draft);
  if (unplaced != nullptr) *unplaced = draft.unplaced;
  return drawing;
}

std::vector<Point2> CornersOf(const Box& box) {
  const auto corners = box.Corners();
  return {corners.begin(), corners.end()};
}

double LengthOfMark(const Group& group, Mark mark) {
  double length = 0;
  for (const Line& line : group.lines) {
    if (line.mark != mark) continue;
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
      length += (line.points[(i + 1) % line.points.size()] - line.points[i]).norm();
  }
  return length;
}

bool HasText(const Group& group, const std::string& text) {
  return std::any_of(group.texts.begin(), group.texts.end(), [&](const Text& t) { return t.text == text; });
}

TEST(PatternDrawing, EveryPieceHasItsNotation) {
  const Pattern pattern = Cushions({60, 25}, 7);
  const Drawing drawing = DrawingOf(pattern);
  int pieces = 0;
  for (const Group& group : drawing.groups) {
    if (!group.is_piece) continue;
    const Piece& piece = pattern.pieces[pieces++];
    std::set<Mark> marks;
    for (const Line& line : group.lines) marks.insert(line.mark);
    EXPECT_EQ(marks.count(Mark::kCut) + marks.count(Mark::kStitch) + marks.count(Mark::kOpening) +
                  marks.count(Mark::kNotch) + marks.count(Mark::kGrain),
              5u);
    for (const std::string& text : {piece.name, std::string("cut 1"), std::string("right side")})
      EXPECT_TRUE(HasText(group, text)) << group.name << ": " << text;
    double rim = 0;
    for (const Seam& seam : pattern.seams)
      for (const SeamSide& side : seam.sides)
        if (side.piece == piece.id) {
          rim += seam.length;
          EXPECT_TRUE(HasText(group, std::to_string(seam.match_points[0].number)));
        }
    EXPECT_NEAR(LengthOfMark(group, Mark::kStitch) + LengthOfMark(group, Mark::kOpening), rim, 1e-9);
  }
  EXPECT_EQ(pieces, 4);
}

TEST(PatternDrawing, ASeamSaysWhatItJoinsOnBothSides) {
  const Drawing drawing = DrawingOf(Cushions({60}, 7));
  EXPECT_TRUE(HasText(drawing.groups[0], "S1: 1 to 2"));
  EXPECT_TRUE(HasText(drawing.groups[1], "S1: 2 to 1"));
  EXPECT_TRUE(HasText(drawing.groups[0], "S3: 1 to 2, opening"));
}

TEST(PatternDrawing, ADoubleNotchHasTwiceTheLines) {
  Pattern pattern = Cushions({60}, 7);
  const auto count = [](const Drawing& drawing) {
    return std::count_if(drawing.groups[0].lines.begin(), drawing.groups[0].lines.end(),
                         [](const Line& line) { return line.mark == Mark::kNotch; });
  };
  EXPECT_EQ(count(DrawingOf(pattern)), 2 * (2 + 1 + 1));  // on the stitch line and on the cut line
  for (Seam& seam : pattern.seams) seam.match_points[0].kind = NotchKind::kSingle;
  EXPECT_EQ(count(DrawingOf(pattern)), 2 * 3);
}

// From pieces with much room to pieces smaller than their labels, which then have leader lines.
TEST(PatternDrawing, LabelsAreInTheirPieceOrHaveALeaderAndOverlapNothing) {
  for (double radius : {60.0, 25.0, 8.0, 3.0}) {
    const Pattern pattern = Cushions({radius, radius}, 7);
    std::vector<std::string> unplaced;
    const Drawing drawing = DrawingOf(pattern, &unplaced);
    EXPECT_TRUE(unplaced.empty()) << radius << ": " << unplaced.front();
    std::vector<std::vector<Point2>> boxes;
    std::size_t leaders = 0, outside = 0;
    for (const Group& group : drawing.groups) {
      if (!group.is_piece) continue;
      std::vector<Polyline> cut;
      for (const Line& line : group.lines) {
        if (line.mark == Mark::kCut) cut.push_back(line.points);
        leaders += line.mark == Mark::kLeader;
      }
      for (const Text& text : group.texts) {
        boxes.push_back(CornersOf(BoxOf(text)));
        outside += !IsInside(cut, text.at);
      }
    }
    EXPECT_LE(outside, 3 * leaders) << radius;  // the name is three lines of text with one leader
    EXPECT_TRUE(radius < 60 || outside == 0);
    EXPECT_TRUE(radius > 3 || leaders > 0);
    for (std::size_t a = 0; a < boxes.size(); ++a) {
      for (std::size_t b = a + 1; b < boxes.size(); ++b)
        EXPECT_FALSE(Overlap(boxes[a], boxes[b])) << "texts " << a << " and " << b << ", radius " << radius;
      for (const Group& group : drawing.groups)
        for (const Line& line : group.lines)
          for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
            EXPECT_FALSE(Overlap(boxes[a], {line.points[i], line.points[(i + 1) % line.points.size()]}))
                << "text " << a << " and a line of " << group.name << ", radius " << radius;
    }
  }
}

TEST(PatternDrawing, ALeaderCrossesNoOtherPiece) {
  const Drawing drawing = DrawingOf(Cushions({8, 3, 3}, 7));
  for (const Group& of_leader : drawing.groups)
    for (const Line& leader : of_leader.lines) {
      if (leader.mark != Mark::kLeader) continue;
      for (const Group& other : drawing.groups) {
        if (&other == &of_leader || !other.is_piece) continue;
        for (const Line& line : other.lines)
          for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
            EXPECT_FALSE(Overlap(leader.points, {line.points[i], line.points[(i + 1) % line.points.size()]}));
      }
    }
}

TEST(LabelSpace, BoxesAndLinesThatTouchOverlap) {
  const std::vector<Point2> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_TRUE(Overlap(square, {{2, 1}, {3, 1}}));
  EXPECT_FALSE(Overlap(square, {{2.01, 1}, {3, 1}}));
  EXPECT_TRUE(Overlap(square, {{-1, 1}, {3, 1}}));
  EXPECT_TRUE(Overlap(square, {{0.5, 0.5}, {1, 1}}));
  EXPECT_FALSE(Overlap(square, {{3, 0}, {0, 3.2}}) && Overlap(square, {{3, 1.5}, {1.5, 3}}));
  EXPECT_FALSE(Overlap({{0, 0}, {1, 1}}, {{2, 2}, {3, 3}}));  // on one line, apart
  LabelSpace space({0, 0}, {100, 100});
  space.AddLine({{0, 0}, {100, 100}}, false, 7);
  EXPECT_FALSE(space.IsFree(Box{{50, 50.5}, {1, 1}, 0}));
  EXPECT_TRUE(space.IsFree(Box{{50, 60}, {1, 1}, 0}));
  EXPECT_FALSE(space.IsFree(Box{{99.5, 20}, {1, 1}, 0})) << "beyond the sheet";
  EXPECT_FALSE(space.IsFree({10, 20}, {20, 10}, -1));
  EXPECT_TRUE(space.IsFree({10, 20}, {20, 10}, 7)) << "a leader may cross its own piece";
}

TEST(PatternFiles, NumbersAreShortAndHaveAPoint) {
  EXPECT_EQ(NumberText(12.5, 4), "12.5");
  EXPECT_EQ(NumberText(-0.00001, 4), "0");
  EXPECT_EQ(NumberText(100, 4), "100");
  EXPECT_EQ(NumberText(1.23456, 4), "1.2346");
}

TEST(PatternFiles, SvgHasMillimetresGroupsLayersAndText) {
  const Pattern pattern = Cushions({40}, 7);
  const std::string svg = SvgFile(DrawingOf(pattern));
  EXPECT_NE(svg.find("width=\"" + NumberText(pattern.sheet_size.x(), 4) + "mm\""), std::string::npos);
  for (const char* part : {"<g id=\"piece-1\"", "<g id=\"piece-2\"", "<g id=\"piece-1-cut\"",
                           "<g id=\"piece-1-stitch\"", "<g id=\"piece-1-text\"", ">S1: 1 to 2</text>",
                           "data-seam=\"1\" data-side=\"1\"", "data-seam=\"1\" data-side=\"2\""})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
}

TEST(PatternFiles, TextIsEscaped) {
  Drawing drawing{"a < b & c", {100, 100}, {{"g", "\"quoted\""}}};
  drawing.groups[0].texts.push_back({"90\xC2\xB0 < 100 %", {50, 50}});
  const std::string svg = SvgFile(drawing);
  EXPECT_NE(svg.find("<title>a &lt; b &amp; c</title>"), std::string::npos);
  EXPECT_NE(svg.find("90\xC2\xB0 &lt; 100 %"), std::string::npos);
  EXPECT_NE(DxfFile(drawing).find("90%%d < 100 %%%"), std::string::npos);
}

TEST(PatternFiles, DxfHasABlockForEachPieceAndDeclaresItsLayers) {
  const std::string dxf = DxfFile(DrawingOf(Cushions({40}, 7)));
  for (const char* part :
       {"$ACADVER\n1\nAC1009", "0\nBLOCK\n8\n1\n2\nPIECE_1\n", "0\nINSERT\n8\n1\n2\nPIECE_2\n",
        "0\nLAYER\n2\n1\n", "0\nLAYER\n2\n4\n", "0\nLAYER\n2\n7\n", "0\nLAYER\n2\n14\n", "0\nLAYER\n2\n15\n",
        "Piece Name: Piece 1", "Quantity: 1,0", "0\nEOF\n"})
    EXPECT_NE(dxf.find(part), std::string::npos) << part;
  // Who cuts along layer 1 cuts no text.
  EXPECT_NE(dxf.find("0\nTEXT\n8\n15\n"), std::string::npos);
  EXPECT_EQ(dxf.find("0\nTEXT\n8\n1\n"), std::string::npos);
}

TEST(PatternFiles, SaysHowManyLabelsFoundNoRoom) {
  // The sheet is hardly larger than the pieces.
  const Pattern pattern = Cushions(std::vector<double>(40, 2), 1);
  Params params;
  params.output_file = testing::TempDir() + "no_room.svg";
  const std::vector<std::string> sentences = WritePattern(pattern, {}, params);
  std::remove(params.output_file.c_str());
  ASSERT_EQ(sentences.size(), 2u);
  const int count = std::atoi(sentences[1].c_str());
  EXPECT_GT(count, 7) << sentences[1];
  EXPECT_NE(sentences[1].find(" labels found no room: Piece 1: "), std::string::npos);
  EXPECT_NE(sentences[1].find("; and " + std::to_string(count - 6) + " more."), std::string::npos)
      << sentences[1];
}

TEST(PatternFiles, DxfSaysOfALineWhatItBelongsTo) {
  const std::string dxf = DxfFile(DrawingOf(Cushions({40}, 7)));
  EXPECT_NE(dxf.find("2\nAPPID\n70\n1\n0\nAPPID\n2\nDCHARTS\n70\n0\n"), std::string::npos);
  for (const char* side : {"1", "2"}) {
    const std::string data =
        std::string("1001\nDCHARTS\n1000\nseam\n1071\n3\n1000\nside\n1071\n") + side + "\n";
    EXPECT_NE(dxf.find(data + "0\nVERTEX\n8\n14\n"), std::string::npos) << "stitch line";
    EXPECT_NE(dxf.find(data + "1000\nmatch\n1071\n3\n0\nVERTEX\n8\n4\n"), std::string::npos) << "notch";
  }
}

TEST(PatternFiles, FoldsHaveTheirAngle) {
  Drawing fold{"fold", {100, 100}, {{"g", "g"}}};
  fold.groups[0].lines.push_back({Mark::kValley, {{0, 0}, {10, 0}}, false, -1, -1, 0, -90});
  EXPECT_NE(DxfFile(fold).find("1001\nDCHARTS\n1000\nangle\n1040\n-90\n"), std::string::npos);
  EXPECT_NE(SvgFile(fold).find(" data-angle=\"-90\""), std::string::npos);
}

TEST(PatternFiles, PdfIsTheSameEveryTime) {
  const auto drawing = std::make_shared<const Drawing>(DrawingOf(Cushions({40}, 7)));
  const std::vector<Page> pages = {{drawing->size, {{drawing, {0, 0}, {0, 0}, {0, 0}}}}};
  const std::string pdf = PdfFile("Cushions", pages);
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_EQ(pdf, PdfFile("Cushions", pages));
}

TEST(PatternFiles, APageMayNotBeLargerThanPdfAllows) {
  const auto drawing = std::make_shared<const Drawing>();
  EXPECT_THROW(PdfFile("x", {{{kLargestPage + 1, 100}, {{drawing, {0, 0}, {0, 0}, {0, 0}}}}}), Error);
}

TEST(PatternFiles, APieceOverThousandsOfPagesIsRefused) {
  for (const double radius : {1000.0, 50000.0}) {
    Pattern pattern = Cushions({radius}, 7);
    pattern.page_size = {210, 297};
    pattern.page_margin = 10;
    for (Piece& piece : pattern.pieces) piece.on_page.page = -1;
    const SurfaceData mesh;
    Draft draft{pattern, mesh, "cushions", false};
    if (radius < 2000)
      EXPECT_EQ(TilingsOf(draft).size(), 2u);
    else
      EXPECT_THROW(TilingsOf(draft), Error);
  }
}

}  // namespace
}  // namespace dcharts
