// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/packing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "common/errors.h"
#include "common/parallel.h"
#include "common/pi.h"
#include "planar/packing_board.h"
#include "planar/packing_compact.h"
#include "planar/packing_squeeze.h"
#include "planar/upright_box.h"

namespace dcharts {
namespace {

// How long few charts are searched for a better packing. Nearly all the time of a small mesh is in here:
// fuzzers take less of it.
#ifdef DCHARTS_QUICK_PACKING
constexpr int kTurns = 16, kCells = 128, kSearches = 1, kMostMoves = 50, kCompactSteps = 50;
#else
constexpr int kTurns = 64, kCells = 512, kSearches = 5, kMostMoves = 3500, kCompactSteps = 300;
#endif
constexpr int kFewCharts = 300;  // more would take long in so many orders

Points2 Turned(const Points2& points, double angle) {
  Eigen::Matrix2d r;
  r << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return points * r.transpose();
}

double EnclosedArea(const Points2& outline) {
  double twice = 0;
  for (Eigen::Index e = 0; e + 1 < outline.rows(); e += 2)
    twice += outline(e, 0) * outline(e + 1, 1) - outline(e, 1) * outline(e + 1, 0);
  return std::abs(twice) / 2;
}

/// One way to place the charts, one after the other.
struct PackPlan {
  std::vector<int> order;
  int width = 0;    ///< of a strip that is filled from below; 0: the square grows from its corner
  double lean = 1;  ///< in a strip: 1 keeps tops low, 0 keeps feet low
};

class Packer {
 public:
  Packer(const std::vector<Points2>& outlines, bool rotate, const std::function<void()>& poll)
      : outlines_(outlines), poll_(poll) {
    const int turns = !rotate                    ? 1
                      : outlines.size() <= 200   ? kTurns
                      : outlines.size() <= 1000  ? 8
                      : outlines.size() <= 10000 ? 4
                                                 : 1;
    for (const Points2& outline : outlines) {
      std::vector<Turn> angles;
      if (rotate && outlines.size() <= kFewCharts) few_ = 4;
      const double upright = rotate ? UprightAngle(outline) : 0;
      for (int k = 0; k < turns; ++k) {
        Turn turn;
        turn.angle = upright + 2 * kPi * k / turns;
        turn.outline = Turned(outline, turn.angle);
        turn.corner = turn.outline.colwise().minCoeff();
        turn.outline.rowwise() -= turn.corner;
        turn.size = turn.outline.colwise().maxCoeff().maxCoeff();
        angles.push_back(std::move(turn));
      }
      turns_.push_back(std::move(angles));
      area_.push_back(EnclosedArea(outline));
    }
  }

  double TotalArea() const { return std::accumulate(area_.begin(), area_.end(), 0.0); }
  double LongestSide() const {
    double longest = 0;
    for (const auto& turns : turns_) longest = std::max(longest, turns.front().size);
    return longest;
  }

  /// Charts by size, largest first: by area (share 1), by length (share 0), or between.
  std::vector<int> OrderBy(double area_share) const {
    std::vector<int> order(outlines_.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> key(outlines_.size());
    for (size_t k = 0; k < key.size(); ++k)
      key[k] = std::pow(area_[k], area_share / 2) * std::pow(turns_[k].front().size, 1 - area_share);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] > key[b]; });
    return order;
  }

  /// Rasterizes all turns of all charts at `scale` cells per unit, `margin` cells around each.
  void Rasterize(double scale, double margin) {
    scale_ = scale;
    margin_ = margin;
    for (auto& turns : turns_) {
      if (poll_) poll_();
      for (size_t t = 0; t < turns.size(); t += few_)
        turns[t].cells = CoveredCells(scale * turns[t].outline, margin);
    }
  }

  /// Places all charts. Returns the side of the square they take, in cells; 0 when it would be `bound` or
  /// more.
  int Try(const PackPlan& plan, int bound, std::vector<Spot>* spots) const {
    if (poll_) poll_();
    Board board(bound);
    spots->assign(outlines_.size(), {});
    int side = plan.width;
    if (side >= bound) return 0;
    // The board only fills up: where a chart found no place, the next one of about its size need not look
    // again. With few charts it looks all the same.
    const bool many = outlines_.size() > kFewCharts;
    std::map<std::pair<int, int>, int> lowest_place;
    for (int k : plan.order) {
      int best_x = -1, best_y = 0;
      double best_score = std::numeric_limits<double>::infinity();
      const Turn* best_turn = nullptr;
      for (size_t t = 0; t < turns_[k].size(); t += few_) {
        const Turn& turn = turns_[k][t];
        int x = 0, y = 0;
        double score = 0;
        if (plan.width > 0) {
          // In a strip: as low as possible, counted at a height between the chart's foot and its top.
          const double highest =
              best_score - plan.lean * turn.cells.Height();  // a foot up there would not be better
          const int below = std::min<double>(bound, std::ceil(highest) + turn.cells.Height());
          int& lowest = lowest_place[SizeClass(turn.cells)];
          if (turn.cells.width > plan.width ||
              !board.FindLowest(turn.cells, plan.width, lowest, below, &x, &y))
            continue;
          if (many) lowest = y;
          score = y + plan.lean * turn.cells.Height() + 1e-3 * x;
        } else {
          // Inside the square that is taken anyway, the place nearest to its corner; else where the square
          // grows least.
          if (!board.FindNearest(turn.cells, std::min<double>(bound, best_score + 1), &x, &y)) continue;
          const int end = std::max(x + turn.cells.width, y + turn.cells.Height());
          score = std::max(end, side) + 1e-3 * (x + y + 0.5 * turn.cells.width + 0.5 * turn.cells.Height());
        }
        if (score >= best_score) continue;
        best_score = score;
        best_x = x;
        best_y = y;
        best_turn = &turn;
      }
      if (!best_turn) return 0;
      board.Take(best_turn->cells, best_x, best_y);
      side = std::max({side, best_x + best_turn->cells.width, best_y + best_turn->cells.Height()});
      (*spots)[k] = {static_cast<int>(best_turn - turns_[k].data()), best_x, best_y};
    }
    return side;
  }

  /// Packs few charts more tightly than one after the other can. Squeezed together on coarse cells by their
  /// middles, charts overlap hardly or not at all; then they are compacted by their outlines. The best of
  /// several searches. `side`, `spots`: where to start; `packing` is that one, and is replaced by a larger.
  void Tighten(int side, const std::vector<Spot>& spots, const CompactOptions& options, Packing* packing) {
    constexpr int kCoarse = 128;
    const double coarse = static_cast<double>(kCoarse) / side;
    scale_ *= coarse;
    margin_ *= coarse;
    std::vector<std::vector<RowRuns>> shapes;
    for (const auto& turns : turns_) {
      shapes.emplace_back();
      for (const Turn& turn : turns) shapes.back().push_back(MiddleCells(scale_ * turn.outline, margin_));
    }
    std::vector<Spot> start = spots;
    for (Spot& s : start) {
      s.x = static_cast<int>(std::lround(s.x * coarse));
      s.y = static_cast<int>(std::lround(s.y * coarse));
    }
    constexpr int kMovesPerChart = 400, kMovesOfMany = 800, kMovesOfAll = 40000;
    const int count = static_cast<int>(turns_.size());
    const int moves =
        std::min({count * kMovesPerChart, std::max(kMovesOfMany, kMovesOfAll / count), kMostMoves});
    std::vector<std::vector<Spot>> moved(kSearches, start);
    std::vector<int> squeezed(kSearches, 0);
    InParallel(kSearches, poll_, [&](int seed, const std::function<void()>& poll) {
      squeezed[seed] =
          Squeeze(shapes, kCoarse + kCoarse / 40, moves, static_cast<unsigned>(seed), poll, &moved[seed]);
    });
    for (int seed = 0; seed < kSearches; ++seed) {
      if (squeezed[seed] == 0) continue;
      Packing tight = PackingOf(moved[seed], squeezed[seed]);
      if (Compact(outlines_, options, packing->scale, poll_, &tight)) {
        tight.padding = packing->padding;
        *packing = std::move(tight);
      }
    }
  }

  /// Of spots in a square of `side` cells.
  Packing PackingOf(const std::vector<Spot>& spots, int side) const {
    Packing packing;
    packing.scale = scale_ / side;
    for (size_t k = 0; k < spots.size(); ++k) {
      const Turn& turn = turns_[k][spots[k].turn];
      packing.placements.push_back({turn.angle, (Eigen::Vector2d(spots[k].x + margin_, spots[k].y + margin_) -
                                                 scale_ * turn.corner.transpose()) /
                                                    side});
    }
    return packing;
  }

 private:
  static std::pair<int, int> SizeClass(const RowRuns& cells) {
    constexpr double kStep = 0.15;
    return {static_cast<int>(std::log(cells.longest_run) / kStep),
            static_cast<int>(std::log(cells.Height()) / kStep)};
  }

  struct Turn {
    double angle = 0;
    Points2 outline;  // turned, with its box's lower left corner at the origin
    Eigen::RowVector2d corner;
    double size = 0;  // longer side of the box
    RowRuns cells;    // at the present scale and margin
  };

  const std::vector<Points2>& outlines_;
  const std::function<void()>& poll_;
  std::vector<std::vector<Turn>> turns_;
  std::vector<double> area_;
  double scale_ = 1, margin_ = 0;
  size_t few_ = 1;  // when charts are placed one by one, only each few_-th turn is tried
};

}  // namespace

Packing Pack(const std::vector<Points2>& outlines, const PackOptions& options,
             const std::function<void()>& poll) {
  Packing packing;
  if (outlines.empty()) return packing;
  Packer packer(outlines, options.rotate, poll);
  const int count = static_cast<int>(outlines.size());
  // Cells along the square: fine ones fit charts closely, but cost time; many charts need many.
  // Finer than texels gains nothing.
  const int cells = std::min(count <= 100    ? kCells
                             : count <= 5000 ? 1024
                                             : 2048,
                             std::max(64, options.texture_size));
  constexpr double kLikelyUse = 0.6;  // of the square
  double scale = cells / std::max(std::sqrt(packer.TotalArea() / kLikelyUse), packer.LongestSide() * 1.02);

  // Large charts first is a good rule, not a law.
  std::vector<PackPlan> plans;
  for (double share : count <= kFewCharts ? std::vector<double>{0.5, 1, 0} : std::vector<double>{0.5}) {
    if (count <= 1000) plans.push_back({packer.OrderBy(share), 0, 1});
    plans.push_back({packer.OrderBy(share), cells, 1});
    if (count <= 1000) plans.push_back({packer.OrderBy(share), cells, 0.5});
  }

  // What a texel is in cells is known only when all are placed: the margin is for a guessed side, which must
  // prove large enough.
  double padding = options.padding, guess = cells;
  constexpr double kMostPadding = 0.5;  // of the texture
  while (count * padding * padding > kMostPadding * options.texture_size * options.texture_size) padding /= 2;
  for (int attempt = 0;; ++attempt) {
    if (attempt == 60)
      throw Error(
          "The charts don't fit into the texture: raise texture_size, lower padding, or take fewer charts.");
    constexpr double kHair = 0.05;  // texels more than the padding, so that rounding doesn't eat into it
    packer.Rasterize(scale, (padding + kHair) / 2 * guess / options.texture_size);
    int side = 0;
    PackPlan best;
    std::vector<Spot> spots, best_spots;
    auto try_plan = [&](const PackPlan& plan) {
      const int found = packer.Try(plan, side > 0 ? side : 2 * cells, &spots);
      if (found == 0) return;
      side = found;
      best = plan;
      best_spots = spots;
    };
    for (const PackPlan& plan : plans) try_plan(plan);
    if (side > 0 && side <= guess) {
      packing = packer.PackingOf(best_spots, side);
      packing.padding = padding;
      if (count == 1) return packing;
      constexpr int kMostSqueezed = 100, kMostCompacted = 5000;  // charts; more would take long
      CompactOptions compact;
      compact.padding = (padding + kHair) / options.texture_size;
      compact.rotate = options.rotate;
      compact.most_steps = count <= 1000 ? kCompactSteps : 100;
      if (count <= kMostCompacted) Compact(outlines, compact, packing.scale, poll, &packing);
      if (count <= kMostSqueezed) packer.Tighten(side, best_spots, compact, &packing);
      return packing;
    }
    if (side > 0) {
      guess = 1.01 * side + 1;
      plans.assign(1, best);
      if (plans[0].width > 0) plans.push_back({best.order, side - 1, best.lean});
    } else {  // far too many charts for these cells: smaller ones, then less padding
      scale *= 0.8;
      if (attempt >= 2) padding /= 2;
    }
  }
}

}  // namespace dcharts
