// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/allowance.h"

#include <algorithm>
#include <string>

#include "common/errors.h"
#include "pattern/outline.h"
#include "pattern/regions.h"
#include "pattern/segments.h"
#include "pattern/texts.h"

namespace dcharts {

void AddAllowances(double allowance, Pattern& pattern) {
  pattern.allowance = allowance;
  double widest = 0;
  std::vector<int> narrow;
  for (const Piece& piece : pattern.pieces) {
    const double width = 2 * piece.label_radius;
    widest = std::max(widest, width);
    if (width < allowance) narrow.push_back(piece.id);
  }
  if (allowance > widest && !pattern.pieces.empty())
    throw Error("seam_allowance (" + LengthText(allowance) + ") is wider than every piece: the widest is " +
                LengthText(widest) + " wide. Give a smaller seam_allowance or a larger size.");
  if (!narrow.empty())
    pattern.warnings.push_back("Narrower than the seam allowance: " + PieceList(narrow) +
                               ". Take a smaller seam_allowance, a larger size or fewer charts.");
  for (Piece& piece : pattern.pieces) {
    const Region net = OutlineOf(piece);
    if (!(allowance > 0)) {
      piece.cut = net;
      continue;
    }
    const std::vector<Region> wide = Widened(net, allowance);
    piece.cut.assign(1, wide.front().front());
    for (size_t h = 1; h < wide.front().size(); ++h) {
      const Polyline& hole = wide.front()[h];
      // A hole of the piece is still one; what the two legs of a dart enclose is not.
      const bool is_hole = std::any_of(net.begin() + 1, net.end(),
                                       [&](const Polyline& loop) { return IsInside({loop}, hole.front()); });
      if (is_hole) piece.cut.push_back(hole);
    }
  }
}

}  // namespace dcharts
