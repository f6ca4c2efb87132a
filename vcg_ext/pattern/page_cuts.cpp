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
  static constexpr int kMostPages = 1000000;

  explicit Turns(const Polyline& points) : Turns(ConvexHull(points), IsHull()) {}

  struct IsHull {};
  Turns(Polyline hull, IsHull) : hull_(std::move(hull)) {
    turned_.reserve(kTurns * hull_.size());
    for (int t = 0; t < kTurns; ++t) {
      Point2 low = Point2::Constant(std::numeric_limits<double>::infinity()), high = -low;
      for (const Point2& p : hull_) {
        const Point2 turned = Turned(p, t);
        turned_.push_back(turned);
        low = low.cwiseMin(turned);
        high = high.cwiseMax(turned);
      }
      low_[t] = low;
      size_[t] = high - low;
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

  /// Of no turn there are fewer pages: those that have the area of the hull together.
  static int LeastPages(const Polyline& hull, const Point2& page) {
    constexpr double kRounding = 1e-9;
    const double pages = std::ceil((1 - kRounding) * SignedArea(hull) / page.prod());
    return static_cast<int>(std::clamp(pages, 1.0, static_cast<double>(kMostPages)));
  }

  /// Pages that the points go onto, in rows as high as a page, at the best turn; `enough` when they are not
  /// less.
  int FewestPages(const Point2& page, int enough = kMostPages) const {
    int fewest = enough;
    std::vector<Row> rows;
    for (int t = 0; t < kTurns; ++t) fewest = PagesOfRows(t, page, fewest, rows);
    return fewest;
  }

 private:
  static constexpr int kTurns = 36;

  struct Row {
    double left = 0, right = 0;
  };

  static Point2 Turned(const Point2& p, int t) {
    static const std::array<Point2, kTurns> turns = [] {
      std::array<Point2, kTurns> made;
      for (int k = 0; k < kTurns; ++k) made[k] = {std::cos(kPi * k / kTurns), std::sin(kPi * k / kTurns)};
      return made;
    }();
    const double c = turns[t].x(), s = turns[t].y();
    return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
  }

  // Pages at a turn, or `fewest` when there are not less. `rows` is room to work in.
  int PagesOfRows(int turn, const Point2& page, int fewest, std::vector<Row>& rows) const {
    constexpr double kMostRows = 1000;
    const Point2 low = low_[turn], high = low + size_[turn];
    const int count =
        std::max(1, static_cast<int>(std::min(kMostRows, std::ceil(size_[turn].y() / page.y()))));
    // No row is without a page.
    if (count >= fewest) return fewest;
    rows.assign(count, {high.x(), low.x()});
    const auto take = [&](int row, double x) {
      Row& into = rows[std::clamp(row, 0, count - 1)];
      into.left = std::min(into.left, x);
      into.right = std::max(into.right, x);
    };
    const double per_row = 1 / page.y();
    const Point2* points = turned_.data() + static_cast<size_t>(turn) * hull_.size();
    for (size_t k = 0; k < hull_.size(); ++k) {
      const Point2 &a = points[k], &b = points[k + 1 < hull_.size() ? k + 1 : 0];
      // In heights of a row. Where an edge goes on to another row it is in both.
      const double from = (a.y() - low.y()) * per_row, to = (b.y() - low.y()) * per_row;
      take(static_cast<int>(std::min(kMostRows, from)), a.x());
      const double slope = (b.x() - a.x()) / (to - from), last = std::min(kMostRows, std::max(from, to));
      for (int row = static_cast<int>(std::min(from, to)) + 1; row <= last; ++row) {
        const double x =
            std::clamp(a.x() + (row - from) * slope, std::min(a.x(), b.x()), std::max(a.x(), b.x()));
        take(row - 1, x);
        take(row, x);
      }
    }
    double pages = 0;
    for (const Row& row : rows) pages += std::max(1.0, std::ceil((row.right - row.left) / page.x()));
    return pages < fewest ? static_cast<int>(pages) : fewest;
  }

  Polyline hull_, turned_;  // turned_: the hull at each turn, one after the other
  std::array<Point2, kTurns> low_, size_;
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

  /// `count`: of directions, and of places for each.
  Cut Best(int count) const {
    const Polyline points = Points();
    const double turn = Turns(points).LongSide();
    Cut best;
    for (int d = 0; d < count; ++d) {
      PlaneLine line;
      const double angle = turn + kPi * d / count;
      line.direction = {std::cos(angle), std::sin(angle)};
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Point2& p : points) {
        low = std::min(low, line.Off(p));
        high = std::max(high, line.Off(p));
      }
      std::vector<double> places;
      for (int k = 1; k < count; ++k) places.push_back(low + (high - low) * k / count);
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
      const double cost =
          opens_hole ? CostOfAll(line, crossings, ends, best.cost) : Cost(line, from, *to, ends, best.cost);
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
  double SliverOf(double width) const {
    constexpr double kNarrow = 0.35;
    return std::max(0.0, 1 - width / (kNarrow * page_.minCoeff()));
  }

  // The pages of a part from which on `cost` of them is not below the bound; `cost` never falls.
  template <class CostOf>
  static int EnoughPages(const CostOf& cost, double bound) {
    int low = 0, high = Turns::kMostPages;
    while (low < high) {
      const int middle = low + (high - low) / 2;
      if (cost(middle) < bound)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }

  // `seam` and `ends` with what the parts cost; or infinity where that is not below the bound. Most cuts are
  // not, and that shows long before the pages of both parts are counted.
  double CostOfParts(double seam, double ends, const std::array<Polyline, 2>& parts, double bound) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    std::array<Polyline, 2> hulls;
    std::array<int, 2> least{};
    std::array<double, 2> sliver{}, cost{};
    const auto total = [&] { return seam + cost[0] + cost[1] + ends; };
    for (const int k : {0, 1}) {
      hulls[k] = ConvexHull(parts[k]);
      least[k] = Turns::LeastPages(hulls[k], page_);
      cost[k] = CostOfPages(least[k]);
    }
    if (total() >= bound) return kNone;
    const std::array<Turns, 2> turns = {Turns(std::move(hulls[0]), Turns::IsHull()),
                                        Turns(std::move(hulls[1]), Turns::IsHull())};
    for (const int k : {0, 1}) {
      const double width = turns[k].Width();
      if (width < least_width_) return kNone;
      sliver[k] = SliverOf(width);
      cost[k] = CostOfPages(least[k] + sliver[k]);
    }
    for (const int k : {0, 1}) {
      const auto with = [&](int pages) {
        cost[k] = CostOfPages(pages + sliver[k]);
        return total();
      };
      const int enough = EnoughPages(with, bound);
      const int pages = turns[k].FewestPages(page_, enough);
      if (pages >= enough && enough < Turns::kMostPages) return kNone;
      with(pages);
    }
    return total();
  }

  // Of a cut from a loop to itself, which parts the chart.
  double Cost(const PlaneLine& line, const BoundaryCrossing& from, const BoundaryCrossing& to, double ends,
              double bound) const {
    const int own = place_[from.half_edge].first, size = static_cast<int>(loops_[own].size());
    std::array<Polyline, 2> parts;
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
    const std::array<Polyline, 2> outlines = parts;
    for (int l = 0; l < static_cast<int>(loops_.size()); ++l) {
      if (l == own) continue;
      bool second = SignedArea(outlines[1]) < 0;
      for (const bool part : {false, true})
        if (SignedArea(outlines[part]) > 0 && IsInside(outlines[part], loops_[l].front())) second = part;
      parts[second].insert(parts[second].end(), loops_[l].begin(), loops_[l].end());
    }
    return CostOfParts(to.along - from.along, ends, parts, bound);
  }

  // Of the whole line: a cut to a hole parts nothing yet, but with the ones after it does.
  double CostOfAll(const PlaneLine& line, const std::vector<BoundaryCrossing>& crossings, double ends,
                   double bound) const {
    double seam = 0;
    std::array<Polyline, 2> parts;
    for (const BoundaryCrossing& crossing : crossings) {
      seam += crossing.leaving ? crossing.along : -crossing.along;
      for (Polyline& part : parts) part.push_back(line.at + crossing.along * line.direction);
    }
    for (const Polyline& loop : loops_)
      for (const Point2& p : loop) parts[line.Off(p) >= 0].push_back(p);
    return CostOfParts(seam, ends, parts, bound);
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
  constexpr int kMostPages = 120, kMostCuts = 500;
  double pages = 0;
  for (const FlatChart& chart : charts.charts) {
    const int own = PagesFor(chart, page);
    if (own > 1) pages += own;
  }
  if (pages > kMostPages)
    throw Error("Pieces that fit onto pages would be more than " + std::to_string(kMostPages) +
                ". Choose a larger page or 'Tile', or a smaller size.");
  // Of large pieces the cheapest cut is one across a corner; the more directions, the more of them, in vain.
  constexpr int kLarge = 10;  // pages
  const int count = pages > kLarge ? 12 : 24;
  int cuts = 0;
  for (int c = 0; c < static_cast<int>(charts.charts.size()); ++c)
    while (cuts < kMostCuts && PagesFor(charts.charts[c], page) > 1) {
      if (poll) poll();
      const CutFinder::Cut cut = CutFinder(charts.charts[c], SeamsOf(charts).places[c], page).Best(count);
      if (!std::isfinite(cut.cost)) break;
      CutAlong(cut.line, cut.from, cut.to, c, charts);
      ++cuts;
    }
  return cuts;
}

}  // namespace dcharts
