// SPDX-License-Identifier: GPL-3.0-or-later
/// A drawing on one sheet, without anything of a file format: what the writers of SVG, PDF and DXF take. All
/// lengths are millimetres, y points upwards, the origin is the sheet's lower left corner.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pattern/pattern.h"

namespace dcharts {

/// What a line means; its layer, width and dashes follow from that (line_styles.h).
enum class Mark {
  kCut,       ///< where scissors go
  kStitch,    ///< where the needle goes
  kOpening,   ///< the seam that stays open until the toy is stuffed
  kNotch,     ///< across the seam allowance at a match point
  kGrain,     ///< along the threads of the fabric
  kMountain,  ///< a fold whose ridge is on the printed side
  kValley,
  kTabFold,  ///< between a piece and its glue tab
  kNet,      ///< of paper: the piece without its tabs, below the lines to cut and to fold
  kRuling,   ///< along which a curved part does not bend
  kLeader,   ///< from a label to what it belongs to
  kSheet     ///< scale bar, frames, tables, registration marks
};

struct Line {
  Mark mark = Mark::kCut;
  Polyline points;
  bool closed = false;
  int seam = -1,
      side = -1;     ///< of a stitch line, a net and a notch: where it is; index into Pattern::seams
  int match = 0;     ///< of a notch: the number of its match point
  double angle = 0;  ///< of a fold: by how much the paper bends, degrees; valleys are negative
};

/// One line of text in Helvetica.
struct Text {
  std::string text;    ///< ASCII and the degree sign (UTF-8)
  Point2 at{0, 0};     ///< the middle of its box, see text_box.h
  double size = 3;     ///< font size, mm
  double angle = 0;    ///< radians, counterclockwise
  std::string astm{};  ///< what a DXF by ASTM D6673 has in its place; empty: the text itself
};

/// A picture, row by row from its upper left corner.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height
  Point2 at{0, 0};                ///< its lower left corner
  Point2 size{0, 0};              ///< mm
  std::vector<Polyline> clip{};   ///< only what is within these loops (even-odd) is shown; empty: all
};

/// What belongs together: a piece, or something on the sheet.
struct Group {
  std::string id;    ///< "piece-3"; letters, digits and hyphens
  std::string name;  ///< "Piece 3"
  bool is_piece = false;
  std::vector<Picture> pictures{};  ///< below the lines
  std::vector<Line> lines{};
  std::vector<Text> texts{};
};

struct Drawing {
  std::string title;
  Point2 size{0, 0};  ///< of the sheet
  std::vector<Group> groups{};
};

}  // namespace dcharts
