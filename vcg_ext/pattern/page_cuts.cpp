// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/page_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "common/errors.h"
#include "common/pi.h"
#include "pattern/chart_cut.h"
#include "pattern/half_edges.h"
#include "pattern/seam_graph.h"
#include "planar/polygon.h"
#include "planar/convex_hull.h"

namespace dcharts {
namespace {

/// Points turned by steps of half a turn; their hull is all that matters.
class Turns {
 public:
  explicit Turns(const Polyline& points) : hull_(ConvexHull(points)) {
    for (int t = 0; t < kTurns; ++t) {
      Point2 low = Point2::Constant(std::numeric_limits<double>::infinity()), high = -low;
      for (const Point2& p : hull_) {
        const Point2 turned = Turned(p, t);
        low = low.cwiseMin(turned);
        high = high.cwiseMax(turned);
      }
      low_.push_back(low);
      size_.emplace_back(high - low);
    }
  }

  double Width() const {
    double width = std::numeric_limits<double>::infinity();
    for (const Point2& size : size_) width = std::min(width, size.minCoeff());
    return width;
  }

  /// The direction in which the points reach farthest, radians.
  double LongSide() const {
    int longest = 0;
    for (int t = 1; t < kTurns; ++t)
      if (size_[t].x() > size_[longest].x()) longest = t;
    return -kPi * longest / kTurns;
  }

  /// Pages that the points go onto, in rows as high as a page, at the best turn.
  int FewestPages(const Point2& page) const {
    int fewest = static_cast<int>(kMostPages);
    for (int t = 0; t < kTurns; ++t) fewest = PagesOfRows(t, page, fewest);
    return fewest;
  }

 private:
  static constexpr int kTurns = 36;
  static constexpr double kMostPages = 1e6;

  static Point2 Turned(const Point2& p, int t) {
    static const std::array<Point2, kTurns> turns = [] {
      std::array<Point2, kTurns> made;
      for (int k = 0; k < kTurns; ++k) made[k] = {std::cos(kPi * k / kTurns), std::sin(kPi * k / kTurns)};
      return made;
    }();
    const double c = turns[t].x(), s = turns[t].y();
    return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
  }

  // Pages at a turn, or `fewest` when there are not less.
  int PagesOfRows(int turn, const Point2& page, int fewest) const {
    const Point2 low = low_[turn], high = low + size_[turn];
    const int rows = std::max(1, static_cast<int>(std::min(1000.0, std::ceil(size_[turn].y() / page.y()))));
    // No row is without a page.
    if (rows >= fewest) return fewest;
    Polyline turned;
    for (const Point2& p : hull_) turned.push_back(Turned(p, turn));
    double pages = 0;
    for (int row = 0; row < rows && pages < fewest; ++row) {
      const double bottom = low.y() + row * page.y(), top = bottom + page.y();
      double left = high.x(), right = low.x();
      const auto take = [&](double x) {
        left = std::min(left, x);
        right = std::max(right, x);
      };
      for (size_t k = 0; k < turned.size(); ++k) {
        const Point2 &a = turned[k], &b = turned[k + 1 < turned.size() ? k + 1 : 0];
        if (a.y() >= bottom && a.y() <= top) take(a.x());
        for (const double y : {bottom, top})
          if ((a.y() < y) != (b.y() < y)) take(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
      }
      pages += std::max(1.0, std::ceil((right - left) / page.x()));
    }
    return pages < fewest ? static_cast<int>(pages) : fewest;
  }

  Polyline hull_;
  std::vector<Point2> low_, size_;
};

/// Whether `at` lies on the way from one point to the other.
bool IsStraight(const Point2& from, const Point2& at, const Point2& to) {
  constexpr double kOff = 1e-9;
  const Point2 way = to - from, part = at - from;
  const double length = way.squaredNorm();
  return std::abs(way.x() * part.y() - way.y() * part.x()) <= kOff * length && way.dot(part) > 0 &&
         way.dot(part) < length;
}

/// Looks for the best straight cut of one chart.
class CutFinder {
 public:
  /// `places`: of the chart's half-edges on seams.
  CutFinder(const FlatChart& chart, const std::vector<SeamPlace>& places, const Point2& page)
      : chart_(chart), opposite_(OppositeHalfEdges(chart)), page_(page) {
    std::vector<char> is_boundary(opposite_.size(), 0);
    for (int h = 0; h < static_cast<int>(opposite_.size()); ++h) {
      if (opposite_[h] >= 0) continue;
      boundary_.push_back(h);
      is_boundary[h] = 1;
    }
    const ChartBoundary around = BoundaryOf(chart, is_boundary);
    place_.resize(is_boundary.size());
    std::vector<char> done(is_boundary.size(), 0);
    for (int first : boundary_) {
      if (done[first]) continue;
      loops_.emplace_back();
      for (int h = first; !done[h]; h = around.leaving[EndOf(chart, h)]) {
        done[h] = 1;
        Polyline& loop = loops_.back();
        const Point2 at = chart.uv.row(StartOf(chart, h)).transpose();
        // Cuts leave hundreds of points along straight lines.
        if (loop.empty() || !IsStraight(loop.back(), at, chart.uv.row(EndOf(chart, h)).transpose()))
          loop.push_back(at);
        place_[h] = {static_cast<int>(loops_.size()) - 1, static_cast<int>(loop.size()) - 1};
        if (places[h].seam != places[around.arriving[StartOf(chart, h)]].seam) seam_ends_.push_back(at);
      }
    }
    constexpr double kLeastWidth = 8;  // mm; of a narrower chart half of its width
    least_width_ = std::min(kLeastWidth, Turns(Points()).Width() / 2);
  }

  struct Cut {
    PlaneLine line{};
    BoundaryCrossing from{}, to{};
    double cost = std::numeric_limits<double>::infinity();
  };

  Cut Best() const {
    constexpr int kDirections = 24, kPlaces = 24;
    const Polyline points = Points();
    const double turn = Turns(points).LongSide();
    Cut best;
    for (int d = 0; d < kDirections; ++d) {
      PlaneLine line;
      const double angle = turn + kPi * d / kDirections;
      line.direction = {std::cos(angle), std::sin(angle)};
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Point2& p : points) {
        low = std::min(low, line.Off(p));
        high = std::max(high, line.Off(p));
      }
      std::vector<double> places;
      for (int k = 1; k < kPlaces; ++k) places.push_back(low + (high - low) * k / kPlaces);
      // As far from either end as fits onto pages.
      constexpr double kLess = 0.999;
      constexpr int kMostPages = 6;
      for (const double side : {page_.x(), page_.y()})
        for (double reach = kLess * side; reach < std::min(high - low, kMostPages * side);
             reach += kLess * side)
          for (const double place : {low + reach, high - reach}) places.push_back(place);
      const Point2 normal(-line.direction.y(), line.direction.x());
      for (const double place : places) {
        line.at = place * normal;
        Try(line, best);
      }
    }
    return best;
  }

 private:
  Polyline Points() const {
    Polyline points;
    for (const Polyline& loop : loops_) points.insert(points.end(), loop.begin(), loop.end());
    return points;
  }

  void Try(const PlaneLine& line, Cut& best) const {
    const std::vector<BoundaryCrossing> crossings = CrossingsOf(chart_, boundary_, line);
    for (const BoundaryCrossing& from : crossings) {
      if (from.leaving) continue;
      const int exit = LeavesAt(chart_, opposite_, line, from.half_edge);
      const auto to = std::find_if(crossings.begin(), crossings.end(),
                                   [&](const BoundaryCrossing& c) { return c.half_edge == exit; });
      if (to == crossings.end() || to->along <= from.along) continue;
      const bool opens_hole = place_[from.half_edge].first != place_[exit].first;
      const double ends = CostOfEnd(line, from) + CostOfEnd(line, *to);
      // Most cuts are worse than the best even if either part would go onto a page.
      const double length = opens_hole ? 0 : to->along - from.along;
      if (ends + length + 2 * CostOfPages(1) >= best.cost) continue;
      const double cost = (opens_hole ? CostOfAll(line, crossings) : Cost(line, from, *to)) + ends;
      if (cost < best.cost) best = {line, from, *to, cost};
    }
  }

  // Seams should not be shorter than can be sewn.
  double CostOfEnd(const PlaneLine& line, const BoundaryCrossing& crossing) const {
    constexpr double kClear = 15, kTooNear = 0.5;  // mm
    double nearest = kClear;
    for (const Point2& end : seam_ends_)
      nearest = std::min(nearest, (line.at + crossing.along * line.direction - end).norm());
    if (nearest < kTooNear) return std::numeric_limits<double>::infinity();
    return 2 * page_.minCoeff() * (1 - nearest / kClear);
  }

  // In mm of seam: a page less is worth a long seam.
  double CostOfPages(double pages) const {
    constexpr double kPage = 2.5;
    return kPage * page_.minCoeff() * pages;
  }

  // Nobody wants slivers.
  double CostOfPart(const Polyline& part) const {
    constexpr double kNarrow = 0.35;
    const Turns turns(part);
    const double width = turns.Width();
    if (width < least_width_) return std::numeric_limits<double>::infinity();
    const double sliver = std::max(0.0, 1 - width / (kNarrow * page_.minCoeff()));
    return CostOfPages(turns.FewestPages(page_) + sliver);
  }

  // Of a cut from a loop to itself, which parts the chart.
  double Cost(const PlaneLine& line, const BoundaryCrossing& from, const BoundaryCrossing& to) const {
    const int own = place_[from.half_edge].first, size = static_cast<int>(loops_[own].size());
    Polyline parts[2];
    for (const bool second : {false, true}) {
      const BoundaryCrossing &begin = second ? to : from, &end = second ? from : to;
      Polyline& part = parts[second];
      part.push_back(line.at + begin.along * line.direction);
      for (int k = place_[begin.half_edge].second; k != place_[end.half_edge].second;) {
        k = (k + 1) % size;
        part.push_back(loops_[own][k]);
      }
      part.push_back(line.at + end.along * line.direction);
    }
    // The other loops are in the part around them. Of a hole that is cut across, one part is all around it.
    const Polyline outlines[2] = {parts[0], parts[1]};
    for (int l = 0; l < static_cast<int>(loops_.size()); ++l) {
      if (l == own) continue;
      bool second = SignedArea(outlines[1]) < 0;
      for (const bool part : {false, true})
        if (SignedArea(outlines[part]) > 0 && IsInside(outlines[part], loops_[l].front())) second = part;
      parts[second].insert(parts[second].end(), loops_[l].begin(), loops_[l].end());
    }
    return to.along - from.along + CostOfPart(parts[0]) + CostOfPart(parts[1]);
  }

  // Of the whole line: a cut to a hole parts nothing yet, but with the ones after it does.
  double CostOfAll(const PlaneLine& line, const std::vector<BoundaryCrossing>& crossings) const {
    double cost = 0;
    Polyline parts[2];
    for (const BoundaryCrossing& crossing : crossings) {
      cost += crossing.leaving ? crossing.along : -crossing.along;
      for (Polyline& part : parts) part.push_back(line.at + crossing.along * line.direction);
    }
    for (const Polyline& loop : loops_)
      for (const Point2& p : loop) parts[line.Off(p) >= 0].push_back(p);
    return cost + CostOfPart(parts[0]) + CostOfPart(parts[1]);
  }

  const FlatChart& chart_;
  std::vector<int> opposite_, boundary_;
  Point2 page_;
  std::vector<Polyline> loops_;
  Polyline seam_ends_;
  double least_width_ = 0;                  // of a part, mm
  std::vector<std::pair<int, int>> place_;  // per boundary half-edge: its loop, and the point before it there
};

}  // namespace

int PagesFor(const Polyline& points, const Point2& page) { return Turns(points).FewestPages(page); }

int PagesFor(const FlatChart& chart, const Point2& page) {
  Polyline points;
  for (Eigen::Index v = 0; v < chart.uv.rows(); ++v) points.push_back(chart.uv.row(v).transpose());
  return PagesFor(points, page);
}

int CutToPages(const Point2& page, const std::function<void()>& poll, FlatCharts& charts) {
  constexpr int kMostPages = 200, kMostCuts = 500;
  double pages = 0;
  for (const FlatChart& chart : charts.charts) {
    const int own = PagesFor(chart, page);
    if (own > 1) pages += own;
  }
  if (pages > kMostPages)
    throw Error("Pieces that fit onto pages would be more than " + std::to_string(kMostPages) +
                ". Choose a larger page or 'Tile', or a smaller size.");
  int cuts = 0;
  for (int c = 0; c < static_cast<int>(charts.charts.size()); ++c)
    while (cuts < kMostCuts && PagesFor(charts.charts[c], page) > 1) {
      if (poll) poll();
      const CutFinder::Cut cut = CutFinder(charts.charts[c], SeamsOf(charts).places[c], page).Best();
      if (!std::isfinite(cut.cost)) break;
      CutAlong(cut.line, cut.from, cut.to, c, charts);
      ++cuts;
    }
  return cuts;
}

}  // namespace dcharts
