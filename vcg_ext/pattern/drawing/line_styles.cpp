// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/line_styles.h"

#include <map>

namespace dcharts {

const LineStyle& StyleOf(Mark mark) {
  static const std::map<Mark, LineStyle> styles = {
      {Mark::kNet, {"net", 14, "CONTINUOUS", 0.08, {}, {200, 200, 200}}},
      {Mark::kRuling, {"fold", 8, "CONTINUOUS", 0.08, {}, {190, 190, 190}}},
      {Mark::kTabFold, {"fold", 8, "DASHED", 0.18, {2, 1.2}, {90, 90, 90}}},
      {Mark::kValley, {"fold", 8, "DASHED", 0.22, {3, 1.5}, {20, 90, 200}}},
      {Mark::kMountain, {"fold", 8, "DASHDOT", 0.22, {4, 1.2, 0.5, 1.2}, {200, 60, 20}}},
      {Mark::kStitch, {"stitch", 14, "DASHED", 0.22, {3, 1.5}, {0, 0, 0}}},
      {Mark::kOpening, {"stitch", 14, "DOT", 0.3, {0.6, 1.6}, {0, 0, 0}}},
      {Mark::kGrain, {"grain", 7, "CONTINUOUS", 0.2, {}, {0, 0, 0}}},
      {Mark::kNotch, {"notch", 4, "CONTINUOUS", 0.25, {}, {0, 0, 0}}},
      {Mark::kCut, {"cut", 1, "CONTINUOUS", 0.35, {}, {0, 0, 0}}},
      {Mark::kLeader, {"text", kAstmText, "CONTINUOUS", 0.12, {}, {90, 90, 90}}},
      {Mark::kSheet, {"sheet", kAstmText, "CONTINUOUS", 0.2, {}, {0, 0, 0}}},
  };
  return styles.at(mark);
}

const std::vector<Mark>& AllMarks() {
  static const std::vector<Mark> marks = {Mark::kNet,      Mark::kRuling, Mark::kTabFold, Mark::kValley,
                                          Mark::kMountain, Mark::kStitch, Mark::kOpening, Mark::kGrain,
                                          Mark::kNotch,    Mark::kCut,    Mark::kLeader,  Mark::kSheet};
  return marks;
}

}  // namespace dcharts
