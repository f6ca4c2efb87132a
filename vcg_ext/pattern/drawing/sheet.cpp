// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/sheet.h"

#include <algorithm>

#include "pattern/drawing/label_space.h"
#include "pattern/drawing/piece_labels.h"
#include "pattern/drawing/piece_lines.h"
#include "pattern/drawing/piece_texture.h"
#include "pattern/drawing/placed_piece.h"
#include "pattern/drawing/sheet_marks.h"
#include "pattern/drawing/text_box.h"

namespace dcharts {

namespace {

constexpr double kClearOfRulings = 0.2;  // mm

// Rulings are all over a piece, so labels lie on them: they are left out there.
void OpenRulings(Group& group) {
  std::vector<Box> boxes;
  for (const Text& text : group.texts) boxes.push_back(BoxOf(text).Grown(kClearOfRulings));
  std::vector<Line> lines;
  for (Line& line : group.lines) {
    if (line.mark != Mark::kRuling) {
      lines.push_back(std::move(line));
      continue;
    }
    for (Polyline& part : OutsideBoxes(line.points[0], line.points[1], boxes))
      lines.push_back({Mark::kRuling, std::move(part)});
  }
  group.lines = std::move(lines);
}

}  // namespace

std::vector<Group> PieceGroups(Draft& draft, const std::vector<const Piece*>& pieces,
                               const std::vector<PiecePlacement>& placements, double margin,
                               const Point2& sheet_size) {
  const Pattern& pattern = draft.pattern;
  std::vector<PlacedPiece> placed;
  std::vector<Group> groups;
  const Point2 corner(margin, margin);
  LabelSpace space(corner, sheet_size - corner);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    placed.push_back(Place(pattern, *pieces[i], placements[i]));
    const std::string number = std::to_string(pieces[i]->id + 1);
    Group group{"piece-" + number, pieces[i]->name, true};
    if (draft.print_texture) {
      Picture texture = PieceTexture(draft.mesh, placed.back());
      if (texture.width > 0) group.pictures.push_back(std::move(texture));
    }
    group.lines = PieceLines(pattern, placed.back());
    for (const Line& line : group.lines)
      if (line.mark != Mark::kRuling) space.AddLine(line.points, line.closed, pieces[i]->id);
    groups.push_back(std::move(group));
  }
  for (std::size_t i = 0; i < placed.size(); ++i)
    for (const std::string& label : AddPieceLabels(pattern, placed[i], placed, space, groups[i]))
      draft.unplaced.push_back(pieces[i]->name + ": " + label);
  for (Group& group : groups) OpenRulings(group);
  return groups;
}

Drawing SheetOf(Draft& draft) {
  const Pattern& pattern = draft.pattern;
  constexpr double kStrip = 24, kLeft = 8, kNarrowest = 150;  // mm
  std::vector<const Piece*> pieces;
  std::vector<PiecePlacement> placements;
  for (const Piece& piece : pattern.pieces) {
    if (!piece.drawn) continue;
    pieces.push_back(&piece);
    placements.push_back(piece.on_sheet);
  }
  Drawing drawing;
  drawing.title = draft.title;
  drawing.size = {std::max(pattern.sheet_size.x(), kNarrowest), pattern.sheet_size.y() + kStrip};
  drawing.groups = PieceGroups(draft, pieces, placements, 0, {drawing.size.x(), pattern.sheet_size.y()});
  Group marks{"sheet", "Sheet"};
  const double bottom = pattern.sheet_size.y();
  AddText(marks, {kLeft, bottom + 17}, draft.title, 4.5);
  AddScaleBar(marks, {kLeft, bottom + 8}, 100);
  AddLegend(marks, {kLeft, bottom + 2}, pattern.material);
  drawing.groups.push_back(std::move(marks));
  return drawing;
}

}  // namespace dcharts
