// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/allowance.h"

#include <algorithm>
#include <string>

#include "common/errors.h"
#include "pattern/outline.h"
#include "pattern/regions.h"
#include "pattern/segments.h"
#include "pattern/texts.h"
#include "planar/polygon.h"

namespace dcharts {
namespace {

// All the edges that the hole lies along are those of darts.
bool IsWithinDart(const Pattern& pattern, const Piece& piece, const Polyline& hole, double allowance) {
  constexpr double kNear = 1.05;
  for (const OutlineLoop& loop : piece.loops)
    for (size_t k = 0; k < loop.size(); ++k) {
      if (pattern.seams[loop[k].seam].is_dart) continue;
      const Point2 &a = loop[k].at, &b = loop[(k + 1) % loop.size()].at;
      for (const Point2& p : hole)
        if (DistanceToSegment(p, a, b) < kNear * allowance) return false;
    }
  return true;
}

// Whether the hole's edge is as far from the net outline as it should be. In a narrow hole it may not be.
bool IsClearOf(const Region& net, const Polyline& hole, double allowance) {
  constexpr double kNearly = 0.9;
  for (const Polyline& loop : net)
    for (size_t k = 0; k < loop.size(); ++k)
      for (const Point2& p : hole)
        if (DistanceToSegment(p, loop[k], loop[(k + 1) % loop.size()]) < kNearly * allowance) return false;
  return true;
}

}  // namespace

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
  std::vector<int> tight;
  for (Piece& piece : pattern.pieces) {
    const Region net = OutlineOf(piece);
    if (!(allowance > 0)) {
      piece.cut = net;
      continue;
    }
    const std::vector<Region> wide = Widened(net, allowance);
    if (wide.empty()) {  // a piece without area
      piece.cut = net;
      continue;
    }
    piece.cut.assign(1, wide.front().front());
    for (size_t h = 1; h < wide.front().size(); ++h) {
      const Polyline& hole = wide.front()[h];
      const bool is_hole = std::any_of(net.begin() + 1, net.end(),
                                       [&](const Polyline& loop) { return IsInside(loop, hole.front()); });
      // What the two legs of a dart enclose is fabric to fold; any other pocket has to be cut out.
      const bool is_pocket = !is_hole && !IsWithinDart(pattern, piece, hole, allowance);
      if (!is_hole && !is_pocket) continue;
      const bool is_clear = IsClearOf(net, hole, allowance);
      if ((is_pocket || !is_clear) && (tight.empty() || tight.back() != piece.id)) tight.push_back(piece.id);
      if (is_clear) piece.cut.push_back(hole);
    }
  }
  if (!tight.empty())
    pattern.warnings.push_back("Too near to themselves for the whole seam allowance: " + PieceList(tight) +
                               ". Cut along the middle there, or take a smaller seam_allowance.");
}

}  // namespace dcharts
