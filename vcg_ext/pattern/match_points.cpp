// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/match_points.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pattern/outline.h"

namespace dcharts {
namespace {

std::vector<double> ArcsOf(const Seam& seam) {
  constexpr double kSpacing = 50;  // mm, about a hand's width of fabric between pins
  constexpr int kMost = 20;
  const int least = seam.closed ? 3 : 1;
  const int count = std::clamp(static_cast<int>(std::lround(seam.length / kSpacing)), least, kMost);
  std::vector<double> arcs;
  if (count == 1) {
    constexpr double kOffMiddle = 0.4;
    arcs.push_back(kOffMiddle * seam.length);
    return arcs;
  }
  // A closed seam has no ends to keep away from.
  for (int k = 0; k < count; ++k)
    arcs.push_back(seam.length * (seam.closed ? static_cast<double>(k) / count : (k + 1.0) / (count + 1.0)));
  return arcs;
}

// Which of the seams, sorted from the longest, is left open: it is closed by hand, so the shortest one that a
// hand goes through.
size_t OpeningOf(const Pattern& pattern, const std::vector<int>& seams) {
  constexpr double kHand = 80;  // mm
  size_t opening = 0;
  while (opening + 1 < seams.size() && pattern.seams[seams[opening + 1]].length >= kHand) ++opening;
  return opening;
}

}  // namespace

void AddMatchPoints(Pattern& pattern) {
  int number = 0;
  for (Seam& seam : pattern.seams) {
    seam.match_points.clear();
    if (seam.IsBorder()) continue;
    const std::vector<double> arcs = ArcsOf(seam);
    for (size_t k = 0; k < arcs.size(); ++k) {
      MatchPoint point;
      point.number = ++number;
      point.arc = arcs[k];
      point.kind = k == 0 && arcs.size() > 1 ? NotchKind::kDouble : NotchKind::kSingle;
      for (int side = 0; side < static_cast<int>(seam.sides.size()); ++side) {
        const OutlinePlace place = PlaceOnSide(pattern, seam, side, arcs[k]);
        point.at.push_back(place.at);
        point.outward.push_back(place.outward);
      }
      seam.match_points.push_back(std::move(point));
    }
  }
}

void SetSewingOrder(Pattern& pattern) {
  int order = 0;
  std::vector<int> open;
  for (Seam& seam : pattern.seams) {
    seam.order = 0;
    seam.opening = false;
    if (seam.is_dart)
      seam.order = ++order;
    else if (!seam.IsBorder())
      open.push_back(seam.id);
  }
  std::stable_sort(open.begin(), open.end(),
                   [&](int a, int b) { return pattern.seams[a].length > pattern.seams[b].length; });
  if (pattern.material == PatternMaterial::kFabric && !open.empty()) {
    const size_t opening = OpeningOf(pattern, open);
    pattern.seams[open[opening]].opening = true;
    open.push_back(open[opening]);
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(opening));
  }
  // The longest first, but always on to what is begun already, so that the work stays in one part.
  std::vector<char> begun(pattern.pieces.size(), 0);
  while (!open.empty()) {
    const auto next = std::find_if(open.begin(), open.end(), [&](int s) {
      const std::vector<SeamSide>& sides = pattern.seams[s].sides;
      return !pattern.seams[s].opening && std::any_of(sides.begin(), sides.end(), [&](const SeamSide& side) {
        return begun[side.piece] != 0;
      });
    });
    const auto chosen = next == open.end() ? open.begin() : next;
    Seam& seam = pattern.seams[*chosen];
    seam.order = ++order;
    for (const SeamSide& side : seam.sides) begun[side.piece] = 1;
    open.erase(chosen);
  }
}

}  // namespace dcharts
