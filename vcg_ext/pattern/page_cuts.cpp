// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/page_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "common/pi.h"
#include "pattern/chart_cut.h"
#include "pattern/seam_graph.h"
#include "pattern/segments.h"

namespace dcharts {
namespace {

constexpr int kTurns = 36;  // of half a turn

Polyline ConvexHull(Polyline points) {
  const auto before = [](const Point2& a, const Point2& b) {
    return std::make_pair(a.x(), a.y()) < std::make_pair(b.x(), b.y());
  };
  std::sort(points.begin(), points.end(), before);
  Polyline hull;
  for (const bool upper : {false, true}) {
    const size_t base = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= base + 2 && Orient(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    if (!upper) std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// What points take when they are turned by a step.
struct Turned {
  Point2 size{0, 0};  ///< of their box
  int pages = 0;      ///< that their hull goes onto, in rows as high as a page
};

int PagesOfRows(const Polyline& hull, const Point2& low, const Point2& high, const Point2& page) {
  const int rows =
      std::max(1, static_cast<int>(std::min(1000.0, std::ceil((high.y() - low.y()) / page.y()))));
  double pages = 0;
  for (int row = 0; row < rows; ++row) {
    const double bottom = low.y() + row * page.y(), top = bottom + page.y();
    double left = high.x(), right = low.x();
    const auto take = [&](double x) {
      left = std::min(left, x);
      right = std::max(right, x);
    };
    for (size_t k = 0; k < hull.size(); ++k) {
      const Point2 &a = hull[k], &b = hull[(k + 1) % hull.size()];
      if (a.y() >= bottom && a.y() <= top) take(a.x());
      for (const double y : {bottom, top})
        if ((a.y() < y) != (b.y() < y)) take(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    pages += std::max(1.0, std::ceil((right - left) / page.x()));
  }
  return static_cast<int>(std::min(pages, 1e6));
}

std::vector<Turned> AllTurns(const Polyline& points, const Point2& page) {
  const Polyline hull = ConvexHull(points);
  std::vector<Turned> turns;
  for (int t = 0; t < kTurns; ++t) {
    const double angle = kPi * t / kTurns, c = std::cos(angle), s = std::sin(angle);
    Point2 low = Point2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    Polyline turned;
    for (const Point2& p : hull) {
      turned.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y());
      low = low.cwiseMin(turned.back());
      high = high.cwiseMax(turned.back());
    }
    turns.push_back({high - low, PagesOfRows(turned, low, high, page)});
  }
  return turns;
}

int FewestPages(const std::vector<Turned>& turns) {
  int fewest = turns.front().pages;
  for (const Turned& turn : turns) fewest = std::min(fewest, turn.pages);
  return fewest;
}

double Width(const std::vector<Turned>& turns) {
  double width = std::numeric_limits<double>::infinity();
  for (const Turned& turn : turns) width = std::min(width, turn.size.minCoeff());
  return width;
}

/// Looks for the best straight cut of one chart.
class CutFinder {
 public:
  CutFinder(const FlatChart& chart, std::vector<int> boundary, const Point2& page)
      : chart_(chart), boundary_(std::move(boundary)), page_(page) {
    std::vector<char> is_boundary(3 * static_cast<size_t>(chart.mesh.triangles.rows()), 0);
    for (int h : boundary_) is_boundary[h] = 1;
    const ChartBoundary around = BoundaryOf(chart, is_boundary);
    place_.resize(is_boundary.size());
    std::vector<char> done(is_boundary.size(), 0);
    for (int first : boundary_) {
      if (done[first]) continue;
      loops_.emplace_back();
      for (int h = first; !done[h]; h = around.leaving[EndOf(chart, h)]) {
        done[h] = 1;
        place_[h] = {static_cast<int>(loops_.size()) - 1, static_cast<int>(loops_.back().size())};
        loops_.back().push_back(chart.uv.row(StartOf(chart, h)).transpose());
      }
    }
  }

  Polyline Points() const {
    Polyline points;
    for (const Polyline& loop : loops_) points.insert(points.end(), loop.begin(), loop.end());
    return points;
  }

  struct Cut {
    PlaneLine line{};
    BoundaryCrossing from{}, to{};
    double cost = std::numeric_limits<double>::infinity();
  };

  Cut Best() const {
    constexpr int kDirections = 24, kPlaces = 24;
    const Polyline points = Points();
    const double turn = LongSide(points);
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
      for (const double side : {page_.x(), page_.y()})
        for (double reach = kLess * side; reach < high - low; reach += kLess * side)
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
  // The direction in which the points reach farthest, radians.
  double LongSide(const Polyline& points) const {
    const std::vector<Turned> turns = AllTurns(points, page_);
    int longest = 0;
    for (int t = 1; t < kTurns; ++t)
      if (turns[t].size.x() > turns[longest].size.x()) longest = t;
    return -kPi * longest / kTurns;
  }

  void Try(const PlaneLine& line, Cut& best) const {
    const std::vector<BoundaryCrossing> crossings = CrossingsOf(chart_, boundary_, line);
    for (size_t k = 0; k + 1 < crossings.size(); ++k) {
      const BoundaryCrossing &from = crossings[k], &to = crossings[k + 1];
      if (from.leaving || !to.leaving) continue;
      const bool opens_hole = place_[from.half_edge].first != place_[to.half_edge].first;
      const double cost = opens_hole ? CostOfAll(line, crossings) : Cost(line, from, to);
      if (cost < best.cost) best = {line, from, to, cost};
    }
  }

  // In mm of seam: a page less is worth a long seam. Nobody wants slivers.
  double CostOfPart(const Polyline& part) const {
    constexpr double kPage = 2.5, kNarrow = 0.35;
    const std::vector<Turned> turns = AllTurns(part, page_);
    const double sliver = std::max(0.0, 1 - Width(turns) / (kNarrow * page_.minCoeff()));
    return kPage * page_.minCoeff() * (FewestPages(turns) + sliver);
  }

  double Cost(const PlaneLine& line, const BoundaryCrossing& from, const BoundaryCrossing& to) const {
    const Polyline& loop = loops_[place_[from.half_edge].first];
    const int size = static_cast<int>(loop.size());
    double cost = to.along - from.along;
    for (const bool second : {false, true}) {
      const int begin = place_[(second ? to : from).half_edge].second,
                end = place_[(second ? from : to).half_edge].second;
      Polyline part;
      for (const BoundaryCrossing& crossing : {from, to})
        part.push_back(line.at + crossing.along * line.direction);
      for (int k = begin; k != end;) {
        k = (k + 1) % size;
        part.push_back(loop[k]);
      }
      cost += CostOfPart(part);
    }
    return cost;
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
  std::vector<int> boundary_;
  Point2 page_;
  std::vector<Polyline> loops_;
  std::vector<std::pair<int, int>> place_;  // per boundary half-edge: its loop, and where in it
};

}  // namespace

int PagesFor(const Polyline& points, const Point2& page) { return FewestPages(AllTurns(points, page)); }

int CutToPages(const Point2& page, const std::function<void()>& poll, FlatCharts& charts) {
  constexpr int kMostCuts = 500;
  int cuts = 0;
  for (int c = 0; c < static_cast<int>(charts.charts.size()); ++c)
    while (cuts < kMostCuts) {
      if (poll) poll();
      std::vector<int> boundary;
      for (const auto& edge : charts.edges)
        for (const ChartEdge& side : edge)
          if (side.chart == c) boundary.push_back(side.half_edge);
      const CutFinder finder(charts.charts[c], std::move(boundary), page);
      if (PagesFor(finder.Points(), page) <= 1) break;
      const CutFinder::Cut cut = finder.Best();
      if (!std::isfinite(cut.cost)) break;
      CutAlong(cut.line, cut.from, cut.to, c, charts);
      ++cuts;
    }
  return cuts;
}

}  // namespace dcharts
