// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/tabs.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/pi.h"
#include "pattern/outline.h"
#include "pattern/regions.h"
#include "pattern/segments.h"

namespace dcharts {
namespace {

constexpr double kShortestTab = 1.5;  // mm, along the seam: nobody can fold and glue a shorter one
constexpr double kClearance = 0.25;   // mm

/// Edges first .. last - 1 of a seam, in its direction: one tab's worth.
struct Stretch {
  int first = 0, last = 0;
};

double TurnBetween(const Point2& a, const Point2& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

// A seam in stretches that are about straight on all sides: over a sharp bend paper can't be folded.
std::vector<Stretch> StretchesOf(const Pattern& pattern, const Seam& seam, double width) {
  constexpr double kMostTurn = 25 * kPi / 180;
  const double longest = 12 * width;
  std::vector<Polyline> sides;
  for (const SeamSide& side : seam.sides) sides.push_back(SideOf(pattern, side));
  std::vector<Stretch> stretches;
  Stretch now;
  double length = 0;
  for (int k = 0; k < seam.sides.front().edges; ++k) {
    bool bends = false;
    for (const Polyline& side : sides)
      bends = bends || TurnBetween(side[now.first + 1] - side[now.first], side[k + 1] - side[k]) > kMostTurn;
    if (k > now.first && (bends || length > longest)) {
      now.last = k;
      stretches.push_back(now);
      now.first = k;
      length = 0;
    }
    length += (sides[0][k + 1] - sides[0][k]).norm();
  }
  now.last = seam.sides.front().edges;
  stretches.push_back(now);
  return stretches;
}

// From end to end.
double LengthOf(const Pattern& pattern, const Seam& seam, const Stretch& stretch) {
  const Polyline line = SideOf(pattern, seam.sides.front());
  return (line[stretch.last] - line[stretch.first]).norm();
}

/// Finds places for tabs, one after the other.
class TabPlacer {
 public:
  explicit TabPlacer(Pattern& pattern) : pattern_(pattern) {
    for (const Piece& piece : pattern.pieces) {
      Region net;
      for (const Polyline& loop : OutlineOf(piece)) {
        net.emplace_back();
        for (const Point2& p : loop) net.back().push_back(OnRegionGrid(p));
      }
      taken_.push_back({net});
    }
  }

  /// A tab of this width, its ends slanting in by `slant` times that. False: there is no room.
  bool Place(const Seam& seam, const Stretch& stretch, int side, double width, double slant) {
    Piece& piece = pattern_.pieces[seam.sides[side].piece];
    const Polyline base = Base(seam.sides[side], stretch);
    const double length = (base.back() - base.front()).norm();
    if (length < kShortestTab) return false;
    Tab tab;
    tab.seam = seam.id;
    tab.side = side;
    // Of a short base the ends would meet: the tab is a lower trapezoid.
    const double height = std::min(width, 0.4 * length / slant);
    tab.outline = Outline(base, height, slant * height);
    const Polyline closed = Closed(base, tab.outline);
    // Scissors must get between the tab and all else: a little larger it would still have room.
    const Polyline with_clearance =
        Closed(base, Outline(base, height + kClearance, std::max(0.0, slant * height - kClearance)));
    if (!IsSimple(closed) || !IsSimple(with_clearance)) return false;
    if (CommonArea({{with_clearance}}, taken_[piece.id]) > 0) return false;
    taken_[piece.id].push_back({closed});
    piece.tabs.push_back(std::move(tab));
    return true;
  }

  // The cut line of a piece: what it and its tabs cover.
  std::vector<Polyline> CutOf(const Piece& piece) const {
    const std::vector<Region> covered = UnionOf(taken_[piece.id]);
    return covered.empty() ? OutlineOf(piece) : covered.front();
  }

 private:
  // The corners of the stretch on this side in the piece's own direction, piece on the left.
  Polyline Base(const SeamSide& side, const Stretch& stretch) const {
    Polyline line = SideOf(pattern_, side);
    line = Polyline(line.begin() + stretch.first, line.begin() + stretch.last + 1);
    if (side.backwards) std::reverse(line.begin(), line.end());
    for (Point2& p : line) p = OnRegionGrid(p);
    return line;
  }

  // A strip beside the base, its ends slanting in by `inset`. From the base's end to its start.
  static Polyline Outline(const Polyline& base, double height, double inset) {
    const Point2 along = (base.back() - base.front()).normalized(), out(along.y(), -along.x());
    double reach = 0;  // how far the base bulges out
    for (const Point2& p : base) reach = std::max(reach, (p - base.front()).dot(out));
    const double far = height + reach;
    const Point2 from = OnRegionGrid(base.front() + inset * along + far * out),
                 to = OnRegionGrid(base.back() - inset * along + far * out);
    return {base.back(), to, from, base.front()};
  }

  static Polyline Closed(const Polyline& base, const Polyline& outline) {
    Polyline closed = base;
    closed.insert(closed.end(), outline.begin() + 1, outline.end() - 1);
    return closed;
  }

  static bool IsSimple(const Polyline& loop) {
    const int n = static_cast<int>(loop.size());
    std::vector<LineSegment> segments;
    for (int k = 0; k < n; ++k) segments.push_back({loop[k], loop[(k + 1) % n], k, (k + 1) % n});
    return !AnyCross(segments);
  }

  Pattern& pattern_;
  std::vector<std::vector<Region>> taken_;  // per piece: itself, then its tabs; on the regions' grid
};

}  // namespace

void AddTabs(double width, const std::function<void()>& poll, Pattern& pattern) {
  TabPlacer placer(pattern);
  int missing = 0;
  int turn = 0;
  for (const Seam& seam : pattern.seams) {
    if (seam.IsBorder() || !(width > 0)) continue;
    const int sides = static_cast<int>(seam.sides.size());
    bool has_tab = false, lacks_tab = false;
    // Where a seam has teeth a tab here and there holds it: not on every tooth.
    constexpr double kTooth = 0.8, kBetweenTeeth = 2;  // tab widths
    double bare = kBetweenTeeth * width;               // length without a tab up to here
    for (const Stretch& stretch : StretchesOf(pattern, seam, width)) {
      if (poll) poll();
      const double length = LengthOf(pattern, seam, stretch);
      if (length < kTooth * width && bare + length < kBetweenTeeth * width) {
        bare += length;
        continue;
      }
      bool placed = false;
      // As wide as asked for on any side, rather than on the one whose turn it is.
      for (const double share : {1.0, 0.7, 0.5, 0.3})
        for (int k = 0; k < sides && !placed; ++k)
          for (const double slant : {1.0, 2.0})
            placed = placed || placer.Place(seam, stretch, (turn + k) % sides, share * width, slant);
      ++turn;
      bare = placed ? 0 : bare + length;
      has_tab = has_tab || placed;
      lacks_tab = lacks_tab || (!placed && length >= kShortestTab);
    }
    if (lacks_tab || (!has_tab && seam.length >= kShortestTab)) ++missing;
  }
  for (Piece& piece : pattern.pieces) piece.cut = placer.CutOf(piece);
  if (missing > 0)
    pattern.warnings.push_back(std::to_string(missing) +
                               " seams have no room for a tab on all of their length: join them with tape "
                               "there, or take a smaller tab_width.");
}

}  // namespace dcharts
