// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/progress.h"
#include "surface/border_band.h"
#include "surface/chart_topology.h"
#include "surface/charts.h"

namespace dcharts {

/// Moves borders by graph cuts: for each pair of adjacent charts the faces near their common border are dealt
/// out anew, such that
///   sum over faces of area * price of the face in its chart + length_weight * length of the border
/// is least (length counts less on creases). Borders with third charts stay where they are; the new border
/// may end elsewhere on them, and on the border of the mesh.
///
/// `Pricing` tells what faces cost. Reach() is how far from the border it wants to see faces;
/// Prepare(a, b, nearby, band, ids) is called for each pair with the faces of both charts up to there and
/// with those that are dealt out; then operator()(k) is the price per area of having face k of the band in b
/// less that of having it in a. It reads nothing of other charts and keeps
/// nothing from one pair for the next: each thread has a copy.
template <class MeshType, class Pricing>
class BorderGraphCut {
 public:
  BorderGraphCut(const SurfaceGraph<MeshType>& surface, const BorderCutOptions& options, Pricing& pricing,
                 Progress& progress)
      : surface_(surface),
        options_(options),
        pricing_(pricing),
        progress_(progress),
        prices_(surface, options.length_weight),
        topology_(surface),
        node_(surface) {}

  /// Every face must have a chart, and every chart be one piece; ids need not be without gaps. Charts keep
  /// their ids. None vanishes, falls apart, loses more than half its area or gets a loop more; a disk stays
  /// a disk. Reads nothing of the faces' order but where two ways are exactly as good.
  void Run(ChartIds& ids) {
    area_at_start_.clear();
    free_.clear();
    for (int sweep = 0; sweep < options_.max_sweeps; ++sweep) {
      const double first = static_cast<double>(sweep) / options_.max_sweeps;
      const double last = static_cast<double>(sweep + 1) / options_.max_sweeps;
      if (!Sweep(ids, first, last)) break;
    }
  }

 private:
  enum class Outcome { kDone, kRefused };
  using Bander = BorderBander<MeshType, Pricing>;

  struct Pair {
    double length;
    int a, b;
    double band = 0;   // how wide it is
    int attempts = 0;  // that were refused
    bool done = false;
  };

  // True when another sweep looks worth while.
  bool Sweep(ChartIds& ids, double progress_from, double progress_to) {
    ReadCharts(ids);
    std::vector<Pair> pairs = AdjacentPairs(ids);
    double price = 0;
    for (const Pair& pair : pairs) price += options_.length_weight * pair.length;
    gain_ = 0;
    const double count = static_cast<double>(pairs.size());
    while (!pairs.empty()) {
      StraightenPairs(Independent(pairs), ids);
      pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [](const Pair& pair) { return pair.done; }),
                  pairs.end());
      progress_.Update(progress_to -
                       (progress_to - progress_from) * static_cast<double>(pairs.size()) / count);
    }
    constexpr double kLittle = 0.01;
    return gain_ / InUnits(1) > kLittle * price;
  }

  void ReadCharts(const ChartIds& ids) {
    const auto faces = FacesOfCharts(ids);
    charts_.assign(faces.size(), {});
    for (size_t c = 0; c < faces.size(); ++c) {
      charts_[c] = {faces[c], static_cast<int>(faces[c].size()), 0};
      for (int f : faces[c]) charts_[c].area += surface_.Area(f);
    }
    if (area_at_start_.empty())
      for (const MovingChart& chart : charts_) area_at_start_.push_back(chart.area);
  }

  // The longest common border first: an order that does not hang on numbers.
  std::vector<Pair> AdjacentPairs(const ChartIds& ids) const {
    std::map<std::pair<int, int>, double> length;
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int g = surface_.Neighbour(h);
      if (g >= 0 && ids[h / 3] < ids[g]) length[{ids[h / 3], ids[g]}] += prices_.Length(h);
    }
    std::vector<Pair> pairs;
    for (const auto& [ab, l] : length) pairs.push_back({l, ab.first, ab.second, options_.band});
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& x, const Pair& y) { return x.length > y.length; });
    return pairs;
  }

  // Those that come next for both of their charts: it is the same whether they come at once or in turn.
  std::vector<Pair*> Independent(std::vector<Pair>& pairs) const {
    std::vector<Pair*> next;
    std::vector<char> taken(charts_.size(), 0);
    for (Pair& pair : pairs) {
      if (!taken[pair.a] && !taken[pair.b]) next.push_back(&pair);
      taken[pair.a] = taken[pair.b] = 1;
    }
    return next;
  }

  void StraightenPairs(const std::vector<Pair*>& pairs, ChartIds& ids) {
    constexpr int kManyFaces = 20000;  // of fewer, a border is not worth a thread
    std::vector<BorderBand> bands(pairs.size());
    InParallelIf(
        surface_.FaceCount() >= kManyFaces, static_cast<int>(pairs.size()), [&] { progress_.Poll(); },
        [&](int k, const std::function<void()>& poll) {
          const auto [a, b] = LargerFirst(*pairs[k]);
          std::unique_ptr<Bander> bander = FreeBander();
          bands[k] = bander->Cut(a, b, pairs[k]->band, charts_, ids, poll);
          const std::lock_guard<std::mutex> lock(mutex_);
          free_.push_back(std::move(bander));
        });
    for (size_t k = 0; k < pairs.size(); ++k) {
      progress_.Poll();
      Pair& pair = *pairs[k];
      const auto [a, b] = LargerFirst(pair);
      const Outcome outcome = bands[k].faces.empty() ? Outcome::kDone : Apply(a, b, bands[k], ids);
      // A change that would spoil a chart often does not when less is in play.
      constexpr int kAttempts = 3;
      pair.band /= 2;
      pair.done = outcome == Outcome::kDone || ++pair.attempts == kAttempts;
    }
  }

  std::pair<int, int> LargerFirst(const Pair& pair) const {
    return charts_[pair.a].area < charts_[pair.b].area ? std::pair(pair.b, pair.a)
                                                       : std::pair(pair.a, pair.b);
  }

  std::unique_ptr<Bander> FreeBander() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!free_.empty()) {
        std::unique_ptr<Bander> bander = std::move(free_.back());
        free_.pop_back();
        return bander;
      }
    }
    return std::make_unique<Bander>(surface_, options_, prices_, pricing_);
  }

  // Changes that hang together stand or fall together, others on their own, the best first.
  Outcome Apply(int a, int b, const BorderBand& band, ChartIds& ids) {
    node_.Set(band.faces);
    node_.ForgetComponents();
    struct Group {
      double gain;
      std::vector<int> nodes;
    };
    std::vector<Group> groups;
    for (int start = 0; start < static_cast<int>(band.faces.size()); ++start) {
      if (node_.Component(start) >= 0 || band.is_a[start] == band.was_a[start]) continue;
      const auto& nodes = node_.Flood(start, [&](int k) { return band.is_a[k] != band.was_a[k]; });
      const double gain = GainOf(nodes, band, ids);
      if (gain > 0) groups.push_back({gain, nodes});
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& x, const Group& y) { return x.gain > y.gain; });
    Outcome outcome = Outcome::kDone;
    std::vector<int> applied;
    double gain = 0;
    for (const Group& group : groups) {
      if (ApplyGroup(group.nodes, a, b, band, ids)) {
        applied.insert(applied.end(), group.nodes.begin(), group.nodes.end());
        gain += group.gain;
      } else {
        outcome = Outcome::kRefused;
      }
    }
    if (applied.empty()) return outcome;
    if (!IsWhole(a, band, ids) || !IsWhole(b, band, ids)) {
      for (int k : applied) Move(band.faces[k], band.was_a[k] ? a : b, ids);
      return Outcome::kRefused;
    }
    gain_ += gain;
    return outcome;
  }

  double GainOf(const std::vector<int>& group, const BorderBand& band, const ChartIds& ids) const {
    double gain = 0;
    for (int k : group) gain += band.was_a[k] ? -band.pull[k] : band.pull[k];
    for (int k : group) {
      const int f = band.faces[k];
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h);
        if (g < 0 || node_[g] < 0) continue;
        const bool with_us = node_.Component(node_[g]) == node_.Component(k);
        if (with_us && g < f) continue;
        const bool parted = ids[f] != ids[g];
        const bool to_be_parted = band.is_a[k] != (with_us ? band.is_a[node_[g]] : band.was_a[node_[g]]);
        gain += prices_.OfEdge(h) * (static_cast<int>(parted) - static_cast<int>(to_be_parted));
      }
    }
    return gain;
  }

  bool ApplyGroup(const std::vector<int>& group, int a, int b, const BorderBand& band, ChartIds& ids) {
    std::vector<int> faces;
    for (int k : group) faces.push_back(band.faces[k]);
    const int before_a = topology_.EulerPart(faces, a, ids), before_b = topology_.EulerPart(faces, b, ids);
    for (int k : group) Move(band.faces[k], band.is_a[k] ? a : b, ids);
    const int after_a = topology_.EulerPart(faces, a, ids), after_b = topology_.EulerPart(faces, b, ids);
    constexpr double kLeastShare = 0.5;
    const bool good =
        after_a >= before_a && after_b >= before_b && charts_[a].area >= kLeastShare * area_at_start_[a] &&
        charts_[b].area >= kLeastShare * area_at_start_[b] && (after_a == before_a || Connected(a, ids)) &&
        (after_b == before_b || Connected(b, ids));
    if (!good)
      for (int k : group) Move(band.faces[k], band.was_a[k] ? a : b, ids);
    return good;
  }

  void Move(int f, int chart, ChartIds& ids) {
    MovingChart &from = charts_[ids[f]], &to = charts_[chart];
    --from.face_count;
    from.area -= surface_.Area(f);
    ++to.face_count;
    to.area += surface_.Area(f);
    to.faces.push_back(f);
    ids[f] = chart;
  }

  // A chart whose faces in the band hang together is whole: it was before, and the rest has not changed.
  bool IsWhole(int chart, const BorderBand& band, const ChartIds& ids) {
    node_.ForgetComponents();
    int pieces = 0;
    for (int k = 0; k < static_cast<int>(band.faces.size()); ++k) {
      if (node_.Component(k) >= 0 || ids[band.faces[k]] != chart) continue;
      if (++pieces > 1) return Connected(chart, ids);
      node_.Flood(k, [&](int n) { return ids[band.faces[n]] == chart; });
    }
    return pieces == 1;
  }

  bool Connected(int chart, const ChartIds& ids) {
    return topology_.IsConnected(chart, charts_[chart].faces, charts_[chart].face_count, ids);
  }

  const SurfaceGraph<MeshType>& surface_;
  const BorderCutOptions options_;
  Pricing& pricing_;
  Progress& progress_;
  const BorderPrices<MeshType> prices_;
  ChartTopology<MeshType> topology_;
  std::vector<MovingChart> charts_;
  std::vector<double> area_at_start_;
  double gain_ = 0;                            // of the present sweep, in units
  BandNodes<MeshType> node_;                   // of the band that is applied
  std::mutex mutex_;                           // of free_
  std::vector<std::unique_ptr<Bander>> free_;  // one for each thread that needed one
};

}  // namespace dcharts
