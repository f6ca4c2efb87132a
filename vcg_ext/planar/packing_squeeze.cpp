// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/packing_squeeze.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

namespace dcharts {
namespace {

// Cells that two charts share.
int SharedCells(const RowRuns& a, const Spot& at_a, const RowRuns& b, const Spot& at_b) {
  if (at_a.x + a.width <= at_b.x || at_b.x + b.width <= at_a.x) return 0;
  const int from = std::max(at_a.y, at_b.y), to = std::min(at_a.y + a.Height(), at_b.y + b.Height());
  int cells = 0;
  for (int y = from; y < to; ++y)
    for (const Run& r : a.rows[static_cast<size_t>(y - at_a.y)])
      for (const Run& s : b.rows[static_cast<size_t>(y - at_b.y)])
        cells += std::max(
            0, std::min(r.last + at_a.x, s.last + at_b.x) - std::max(r.first + at_a.x, s.first + at_b.x) + 1);
  return cells;
}

class GuidedSearch {
 public:
  GuidedSearch(const std::vector<std::vector<RowRuns>>& shapes, int side, int most_moves, unsigned seed,
               const std::function<void()>& poll, std::vector<Spot>& spots)
      : shapes_(shapes),
        count_(static_cast<int>(shapes.size())),
        stride_((side + kBlock - 1) / kBlock * kBlock),
        moves_left_(most_moves),
        poll_(poll),
        spots_(spots),
        sums_(static_cast<size_t>(stride_) * (side + 1)),
        random_(seed + 1) {
    for (const auto& turns : shapes) {
      spans_.emplace_back();
      for (const RowRuns& cells : turns) spans_.back().push_back(SpansOf(cells));
    }
  }

  // Tries to free the charts of overlap within a square of this side.
  bool Fit(int side, int most_rounds) {
    side_ = side;
    --moves_left_;  // here and per round: so there is an end even when no chart can move
    weight_.assign(static_cast<size_t>(count_) * count_, kUnit);
    for (int k = 0; k < count_; ++k) {
      const RowRuns& cells = Shape(k);
      if (std::max(cells.width, cells.Height()) > side && !TurnToFit(k)) return false;
      Spot& s = spots_[k];
      s.x = std::clamp(s.x, 0, side - Shape(k).width);
      s.y = std::clamp(s.y, 0, side - Shape(k).Height());
    }
    int best = std::numeric_limits<int>::max(), rounds_since = 0;
    for (; moves_left_ > 0; --moves_left_) {
      const std::vector<int> bad = Overlapping();
      if (bad.empty()) return true;
      if (total_ < best) {
        best = total_;
        rounds_since = 0;
      } else if (++rounds_since > most_rounds) {
        return false;
      }
      if (poll_) poll_();
      for (int k : bad) Move(k);
    }
    return false;
  }

  int MovesLeft() const { return moves_left_; }

  // Lets two large charts change places.
  void SwapTwo() {
    if (count_ < 2) return;
    std::vector<int> order(count_);
    std::iota(order.begin(), order.end(), 0);
    const auto size = [&](int k) { return Shape(k).width * Shape(k).Height(); };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size(a) > size(b); });
    const auto large = static_cast<unsigned>(std::max(2, count_ / 2));
    const int a = order[random_() % large], b = order[random_() % large];
    const Spot of_a = spots_[a], of_b = spots_[b];
    const int dx = (Shape(a).width - Shape(b).width) / 2, dy = (Shape(a).Height() - Shape(b).Height()) / 2;
    spots_[a].x = of_b.x - dx;
    spots_[a].y = of_b.y - dy;
    spots_[b].x = of_a.x + dx;
    spots_[b].y = of_a.y + dy;
  }

 private:
  const RowRuns& Shape(int k) const { return shapes_[k][spots_[k].turn]; }

  bool TurnToFit(int k) {
    for (int t = 0; t < static_cast<int>(shapes_[k].size()); ++t)
      if (std::max(shapes_[k][t].width, shapes_[k][t].Height()) <= side_) {
        spots_[k].turn = t;
        return true;
      }
    return false;
  }

  // Charts that overlap others, in random order. Pairs that do get more weight.
  std::vector<int> Overlapping() {
    std::vector<char> is_bad(count_, 0);
    std::vector<std::pair<size_t, int>> pairs;
    total_ = 0;
    int most = 0;
    for (int i = 0; i < count_; ++i)
      for (int j = i + 1; j < count_; ++j) {
        const int shared = SharedCells(Shape(i), spots_[i], Shape(j), spots_[j]);
        if (shared == 0) continue;
        is_bad[i] = is_bad[j] = 1;
        total_ += shared;
        most = std::max(most, shared);
        pairs.push_back({static_cast<size_t>(i) * count_ + j, shared});
      }
    for (const auto& [pair, shared] : pairs) {
      const size_t i = pair / count_, j = pair % count_;
      int& w = weight_[pair];
      w = std::min(kMostWeight, w + w / 5 + static_cast<int>(w * std::int64_t{shared} * 4 / (5 * most)));
      weight_[j * count_ + i] = w;
    }
    std::vector<int> bad;
    for (int k = 0; k < count_; ++k)
      if (is_bad[k]) bad.push_back(k);
    for (size_t k = bad.size(); k > 1; --k) std::swap(bad[k - 1], bad[random_() % k]);
    return bad;
  }

  // sums_[x][y]: weight of the other charts in row y left of column x.
  void SumUpOthers(int k) {
    std::fill(sums_.begin(), sums_.end(), 0);
    for (int j = 0; j < count_; ++j) {
      if (j == k) continue;
      const int w = weight_[static_cast<size_t>(k) * count_ + j];
      const RowRuns& cells = Shape(j);
      for (int r = 0; r < cells.Height(); ++r) {
        int* at = &sums_[static_cast<size_t>(spots_[j].x) * stride_ + spots_[j].y + r];
        for (const Run& run : cells.rows[r]) {
          at[run.first * stride_] += w;
          at[(run.last + 1) * stride_] -= w;
        }
      }
    }
    // Column after column, a block of rows side by side: more than compilers unroll, so that they use
    // vectors.
    for (int y = 0; y < side_; y += kBlock) {
      int weights[kBlock] = {}, sum[kBlock] = {};
      for (int x = 0; x <= side_; ++x) {
        int* at = &sums_[static_cast<size_t>(x) * stride_ + y];
        for (int i = 0; i < kBlock; ++i) {
          const int change = at[i];
          at[i] = sum[i];
          weights[i] += change;
          sum[i] += weights[i];
        }
      }
    }
  }

  // Where a run begins and ends in sums_, counted from the chart's corner.
  struct Span {
    int begin, end;
  };

  // Rows far apart first: most places are given up after a few.
  std::vector<Span> SpansOf(const RowRuns& cells) const {
    std::vector<Span> spans;
    const int height = cells.Height(), stride = std::max(1, height / 8);
    for (int start = 0; start < stride; ++start)
      for (int r = start; r < height; r += stride)
        for (const Run& run : cells.rows[r])
          spans.push_back({run.first * stride_ + r, (run.last + 1) * stride_ + r});
    return spans;
  }

  // Weight of the others under the chart; anything of `enough` or more when it is that much.
  int Cost(const std::vector<Span>& spans, int x, int y, int enough) const {
    const int* const at = &sums_[static_cast<size_t>(x) * stride_ + y];
    const auto under = [at](const Span& span) { return at[span.end] - at[span.begin]; };
    const Span *span = spans.data(), *const end = span + spans.size();
    int cost = 0;
    for (; end - span >= 4; span += 4) {
      cost += (under(span[0]) + under(span[1])) + (under(span[2]) + under(span[3]));
      if (cost >= enough) return cost;
    }
    for (; span != end; ++span) cost += under(*span);
    return cost;
  }

  struct Candidate {
    Spot spot;
    int cost;
  };

  // Walks downhill from a place; turns by one step where that helps.
  void Descend(int k, int step, Candidate& c) const {
    constexpr int kAround[10][3] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0}, {0, 1, 0},  {-1, -1, 0},
                                    {1, -1, 0}, {-1, 1, 0}, {1, 1, 0},  {0, 0, -1}, {0, 0, 1}};
    const std::vector<RowRuns>& turns = shapes_[k];
    const int turn_count = static_cast<int>(turns.size());
    for (; step >= 1 && c.cost > 0; step /= 2)
      for (bool better = true; better && c.cost > 0;) {
        better = false;
        for (const auto& d : kAround) {
          const Spot& at = c.spot;
          Spot to{(at.turn + d[2] + turn_count) % turn_count, at.x + step * d[0], at.y + step * d[1]};
          const RowRuns& cells = turns[to.turn];
          if (d[2] != 0) {  // about the middle of the box
            if (to.turn == at.turn) continue;
            to.x += (turns[at.turn].width - cells.width) / 2;
            to.y += (turns[at.turn].Height() - cells.Height()) / 2;
          }
          if (to.x < 0 || to.y < 0 || to.x + cells.width > side_ || to.y + cells.Height() > side_) continue;
          const int cost = Cost(spans_[k][to.turn], to.x, to.y, c.cost);
          if (cost >= c.cost) continue;
          c = {to, cost};
          better = true;
          break;
        }
      }
  }

  // Puts a chart where it overlaps least, as far as a search of some places shows.
  void Move(int k) {
    SumUpOthers(k);
    const std::vector<RowRuns>& turns = shapes_[k];
    Candidate best{spots_[k], 0};
    best.cost = Cost(spans_[k][spots_[k].turn], spots_[k].x, spots_[k].y, std::numeric_limits<int>::max());
    if (best.cost == 0) return;
    --moves_left_;
    Candidate here = best;
    Descend(k, 4, here);
    if (here.cost < best.cost) best = here;
    const int turn_count = static_cast<int>(turns.size());
    // Of the places to walk downhill from.
    const int bound = std::min(best.cost, std::numeric_limits<int>::max() / kStartBound) * kStartBound;
    for (int n = 0; n < std::min(kTurnsTried, turn_count) && best.cost > 0; ++n) {
      const int t = n == 0 ? spots_[k].turn : static_cast<int>(random_() % static_cast<unsigned>(turn_count));
      const RowRuns& cells = turns[t];
      const int most_x = side_ - cells.width, most_y = side_ - cells.Height();
      if (most_x < 0 || most_y < 0) continue;
      const int step = std::max(3, std::min({cells.width, cells.Height(), side_ / 4}) / 6);
      Candidate found{{t, 0, 0}, bound};
      const int first_x = static_cast<int>(random_() % static_cast<unsigned>(std::min(step, most_x + 1))),
                first_y = static_cast<int>(random_() % static_cast<unsigned>(std::min(step, most_y + 1)));
      for (int y = first_y; y <= most_y; y += step)
        for (int x = first_x; x <= most_x; x += step) {
          const int cost = Cost(spans_[k][t], x, y, found.cost);
          if (cost < found.cost) found = {{t, x, y}, cost};
        }
      if (found.cost == bound) continue;
      Descend(k, std::max(1, step / 2), found);
      if (found.cost < best.cost) best = found;
    }
    spots_[k] = best.spot;
  }

  static constexpr int kBlock = 32, kUnit = 16, kMostWeight = 1 << 9, kTurnsTried = 4, kStartBound = 2;

  const std::vector<std::vector<RowRuns>>& shapes_;
  const int count_;
  const int stride_;  // of sums_
  int moves_left_;
  const std::function<void()>& poll_;
  std::vector<Spot>& spots_;
  std::vector<int> sums_;
  std::vector<std::vector<std::vector<Span>>> spans_;  // of shapes_
  std::vector<int> weight_;                            // per pair, both ways
  int side_ = 0;
  int total_ = 0;  // cells of overlap
  std::minstd_rand random_;
};

}  // namespace

int Squeeze(const std::vector<std::vector<RowRuns>>& shapes, int side, int most_moves, unsigned seed,
            const std::function<void()>& poll, std::vector<Spot>* spots) {
  constexpr int kRounds = 30;  // without less overlap than before
  std::vector<Spot> tried = *spots;
  GuidedSearch search(shapes, side, most_moves, seed, poll, tried);
  int found = 0, step = std::max(1, side / 50), target = side;
  while (search.MovesLeft() > 0) {
    if (search.Fit(target, kRounds)) {
      found = target;
      *spots = tried;
    } else {
      if (found > 0) step = std::max(1, step / 2);
      tried = *spots;
      search.SwapTwo();
    }
    target = found > 0 ? found - step : side;
  }
  return found;
}

}  // namespace dcharts
