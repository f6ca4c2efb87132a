// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/piece_lines.h"

#include <algorithm>
#include <cmath>

namespace dcharts {

namespace {

constexpr double kLongestSlit = 4;       // mm; the rest of the allowance stays whole
constexpr double kPaperTick = 1.5;       // mm
constexpr double kBetweenSlits = 2;      // mm, of a double notch
constexpr double kAcrossStitchLine = 1;  // mm to each side

class LineMaker {
 public:
  LineMaker(const Pattern& pattern, const PlacedPiece& placed) : pattern_(pattern), placed_(placed) {}

  std::vector<Line> Make() {
    AddSeams();
    for (const Tab& tab : placed_.piece->tabs) AddTabFold(tab);
    for (const Ruling& ruling : placed_.piece->rulings)
      Add(Mark::kRuling, placed_.Placed({ruling.from, ruling.to}));
    for (const Fold& fold : placed_.piece->folds) AddFold(fold);
    for (const Seam& seam : pattern_.seams)
      for (const MatchPoint& point : seam.match_points) AddNotches(seam, point);
    for (const Polyline& loop : placed_.cut) lines_.push_back({Mark::kCut, loop, true});
    return std::move(lines_);
  }

 private:
  bool IsPaper() const { return pattern_.material == PatternMaterial::kPaper; }

  void Add(Mark mark, Polyline points) { lines_.push_back({mark, std::move(points)}); }

  void AddFold(const Fold& fold) {
    Add(fold.mountain ? Mark::kMountain : Mark::kValley, placed_.Placed(fold.line));
    lines_.back().angle = fold.mountain ? fold.angle_degrees : -fold.angle_degrees;
  }

  void AddSeams() {
    for (const SideRun& run : placed_.sides) {
      const bool opening = pattern_.seams[run.seam].opening;
      const Mark mark = IsPaper() ? Mark::kNet : opening ? Mark::kOpening : Mark::kStitch;
      lines_.push_back({mark, run.points, false, run.seam, run.side});
    }
  }

  // The part of the net outline that the tab hangs on.
  void AddTabFold(const Tab& tab) {
    for (const SideRun& run : placed_.sides) {
      if (run.seam != tab.seam || run.side != tab.side) continue;
      const double a = NearestLength(run.points, placed_.placement(tab.outline.front()));
      const double b = NearestLength(run.points, placed_.placement(tab.outline.back()));
      if (a != b) Add(Mark::kTabFold, Part(run.points, std::min(a, b), std::max(a, b)));
    }
  }

  void AddNotches(const Seam& seam, const MatchPoint& point) {
    for (std::size_t s = 0; s < seam.sides.size(); ++s) {
      if (seam.sides[s].piece != placed_.piece->id) continue;
      const Point2 at = placed_.placement(point.at[s]), outward = placed_.Turned(point.outward[s]);
      const std::size_t first = lines_.size();
      if (point.kind == NotchKind::kSingle)
        AddNotch(at, outward);
      else
        AddDoubleNotch(seam.id, static_cast<int>(s), at, outward);
      for (std::size_t i = first; i < lines_.size(); ++i) {
        lines_[i].seam = seam.id;
        lines_[i].side = static_cast<int>(s);
        lines_[i].match = point.number;
      }
    }
  }

  // Both halves lie on the outline, also near its corners.
  void AddDoubleNotch(int seam, int side, const Point2& at, const Point2& outward) {
    for (const SideRun& run : placed_.sides) {
      if (run.seam != seam || run.side != side) continue;
      const double middle = NearestLength(run.points, at);
      for (const double step : {-kBetweenSlits / 2, kBetweenSlits / 2})
        AddNotch(AtLength(run.points, std::max(0.0, middle + step)).first, outward);
    }
  }

  // Fabric: a slit from the cut line, not as far as the stitch line, and a tick across the latter. Paper: a
  // tick inwards, since a tab may be outside.
  void AddNotch(const Point2& at, const Point2& outward) {
    if (IsPaper()) {
      Add(Mark::kNotch, {at, at - kPaperTick * outward});
      return;
    }
    Add(Mark::kNotch, {at - kAcrossStitchLine * outward, at + kAcrossStitchLine * outward});
    const double width = FirstHit(at, outward, placed_.cut);
    if (width > 2 * kAcrossStitchLine)
      Add(Mark::kNotch, {at + width * outward, at + (width - std::min(kLongestSlit, width / 2)) * outward});
  }

  const Pattern& pattern_;
  const PlacedPiece& placed_;
  std::vector<Line> lines_;
};

}  // namespace

std::vector<Line> PieceLines(const Pattern& pattern, const PlacedPiece& placed) {
  return LineMaker(pattern, placed).Make();
}

}  // namespace dcharts
