// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/sheet_marks.h"

#include "pattern/drawing/number_text.h"
#include "pattern/drawing/text_box.h"

namespace dcharts {

void AddText(Group& group, const Point2& start, const std::string& text, double size) {
  Text line{text, {0, 0}, size};
  line.at = start + Point2(TextWidth(text) * size / 2, (kAscent - kDescent) * size / 2);
  group.texts.push_back(std::move(line));
}

void AddScaleBar(Group& group, const Point2& at, double length) {
  constexpr double kTick = 10, kHeight = 2;
  group.lines.push_back({Mark::kSheet, {at, at + Point2(length, 0)}});
  for (double x = 0; x <= length; x += kTick)
    group.lines.push_back({Mark::kSheet, {at + Point2(x, 0), at + Point2(x, kHeight)}});
  AddText(group, at + Point2(length + 2, 0.1), NumberText(length, 0) + " mm when printed at 100 %", 2.6);
}

double AddLegend(Group& group, const Point2& at, PatternMaterial material) {
  const std::vector<std::pair<Mark, const char*>> fabric = {
      {Mark::kCut, "cut"}, {Mark::kStitch, "stitch"}, {Mark::kOpening, "opening"}, {Mark::kGrain, "grain"}};
  const std::vector<std::pair<Mark, const char*>> paper = {{Mark::kCut, "cut"},
                                                           {Mark::kMountain, "mountain fold"},
                                                           {Mark::kValley, "valley fold"},
                                                           {Mark::kTabFold, "fold of a tab"},
                                                           {Mark::kRuling, "bends here"}};
  constexpr double kSample = 14, kSize = 2.6, kGap = 5;
  double x = 0;
  for (const auto& [mark, name] : material == PatternMaterial::kFabric ? fabric : paper) {
    group.lines.push_back({mark, {at + Point2(x, 1), at + Point2(x + kSample, 1)}});
    x += kSample + 1.5;
    AddText(group, at + Point2(x, 0.1), name, kSize);
    x += TextWidth(name) * kSize + kGap;
  }
  return x - kGap;
}

Group Moved(Group group, const Point2& by) {
  for (Picture& picture : group.pictures) {
    picture.at += by;
    for (Polyline& loop : picture.clip)
      for (Point2& p : loop) p += by;
  }
  for (Line& line : group.lines)
    for (Point2& p : line.points) p += by;
  for (Text& text : group.texts) text.at += by;
  return group;
}

}  // namespace dcharts
