// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "common/progress.h"
#include "planar/min_cut.h"
#include "surface/chart_topology.h"
#include "surface/charts.h"
#include "surface/crease_weight.h"
#include "surface/dual_distance.h"

namespace dcharts {

/// Lengths are those of a surface of area 1. The defaults are those of straightening.
struct BorderCutOptions {
  double band = 0.08;            ///< how far from the old border the new one may lie, > 0
  double length_weight = 0.006;  ///< price of border length against area times price of a face, > 0
  int max_sweeps = 2;            ///< over all pairs of charts; fewer where a sweep gains little, >= 1
};

/// Moves borders by graph cuts: for each pair of adjacent charts the faces near their common border are dealt
/// out anew, such that
///   sum over faces of area * price of the face in its chart + length_weight * length of the border
/// is least (length counts less on creases). Borders with third charts stay where they are; the new border
/// may end elsewhere on them, and on the border of the mesh.
///
/// `Pricing` tells what faces cost. Reach() is how far from the border it wants to see faces;
/// Prepare(a, b, nearby, band, ids) is called for each pair with the faces of both charts up to there and
/// with those that are dealt out; then operator()(k) is the price per area of having face k of the band in b
/// less that of having it in a.
template <class MeshType, class Pricing>
class BorderGraphCut {
 public:
  BorderGraphCut(const SurfaceGraph<MeshType>& surface, const BorderCutOptions& options, Pricing& pricing,
                 Progress& progress)
      : surface_(surface),
        options_(options),
        pricing_(pricing),
        progress_(progress),
        unit_area_(surface.TotalArea()),
        unit_length_(std::sqrt(surface.TotalArea())),
        crease_weight_(CreaseWeights(surface)),
        distance_(surface),
        topology_(surface),
        face_stamp_(surface.FaceCount(), 0),
        node_(surface.FaceCount(), -1) {}

  /// Every face must have a chart, and every chart be one piece; ids need not be without gaps. Charts keep
  /// their ids. None vanishes, falls apart, loses more than half its area or gets a loop more; a disk stays
  /// a disk. Reads nothing of the faces' order but where two ways are exactly as good.
  void Run(ChartIds& ids) {
    area_at_start_.clear();
    for (int sweep = 0; sweep < options_.max_sweeps; ++sweep) {
      const double first = static_cast<double>(sweep) / options_.max_sweeps;
      const double last = static_cast<double>(sweep + 1) / options_.max_sweeps;
      if (!Sweep(ids, first, last)) break;
    }
  }

 private:
  enum class Outcome { kDone, kRefused };

  struct Chart {
    std::vector<int> faces;  // may hold faces that have left, and some twice
    int face_count = 0;
    double area = 0;
  };

  struct Pair {
    double length;
    int a, b;
  };

  // True when another sweep looks worth while.
  bool Sweep(ChartIds& ids, double progress_from, double progress_to) {
    ReadCharts(ids);
    const std::vector<Pair> pairs = AdjacentPairs(ids);
    double price = 0;
    for (const Pair& pair : pairs) price += options_.length_weight * pair.length;
    gain_ = 0;
    for (size_t k = 0; k < pairs.size(); ++k) {
      progress_.Update(progress_from + (progress_to - progress_from) * static_cast<double>(k) /
                                           static_cast<double>(pairs.size()));
      // A change that would spoil a chart often does not when less is in play.
      constexpr int kAttempts = 3;
      double band = options_.band;
      for (int attempt = 0; attempt < kAttempts; ++attempt, band /= 2)
        if (StraightenPair(pairs[k].a, pairs[k].b, band, ids) == Outcome::kDone) break;
    }
    constexpr double kLittle = 0.01;
    return gain_ > kLittle * price;
  }

  void ReadCharts(const ChartIds& ids) {
    const auto faces = FacesOfCharts(ids);
    charts_.assign(faces.size(), {});
    for (size_t c = 0; c < faces.size(); ++c) {
      charts_[c] = {faces[c], static_cast<int>(faces[c].size()), 0};
      for (int f : faces[c]) charts_[c].area += surface_.Area(f);
    }
    if (area_at_start_.empty())
      for (const Chart& chart : charts_) area_at_start_.push_back(chart.area);
  }

  // The longest common border first: an order that does not hang on numbers.
  std::vector<Pair> AdjacentPairs(const ChartIds& ids) const {
    std::map<std::pair<int, int>, double> length;
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int g = surface_.Neighbour(h);
      if (g >= 0 && ids[h / 3] < ids[g])
        length[{ids[h / 3], ids[g]}] += crease_weight_[h] * surface_.Length(h) / unit_length_;
    }
    std::vector<Pair> pairs;
    for (const auto& [ab, l] : length) pairs.push_back({l, ab.first, ab.second});
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& x, const Pair& y) { return x.length > y.length; });
    return pairs;
  }

  Outcome StraightenPair(int a, int b, double band, ChartIds& ids) {
    if (charts_[a].area < charts_[b].area) std::swap(a, b);
    progress_.Poll();
    if (!CollectBand(a, b, band, ids)) return Outcome::kDone;
    progress_.Poll();
    PriceBand(a, b, ids);
    progress_.Poll();
    side_ = BandedMinCut(pull_, edges_, [this] { progress_.Poll(); });
    DropIslands(a, b);
    progress_.Poll();
    return ApplyCut(a, b, ids);
  }

  // The faces of both charts near their common border, with node numbers in node_.
  bool CollectBand(int a, int b, double band, const ChartIds& ids) {
    constexpr double kDepth = 0.25;  // of the smaller chart's size
    const double depth =
        std::min(band * unit_length_, kDepth * std::sqrt(std::min(charts_[a].area, charts_[b].area)));
    const auto [small, large] =
        charts_[a].face_count <= charts_[b].face_count ? std::pair(a, b) : std::pair(b, a);
    sources_.clear();
    ++stamp_;
    for (int f : charts_[small].faces) {
      if (ids[f] != small) continue;
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        if (surface_.Neighbour(h) < 0 || ids[surface_.Neighbour(h)] != large) continue;
        // Faces that touch the border with a corner too: on a coarse mesh there would be no room else.
        for (int v : {surface_.Vertex(h), surface_.Vertex(Next(h))})
          for (const int* r = surface_.RingBegin(v); r != surface_.RingEnd(v); ++r) {
            const int neighbor = *r / 3;
            if (face_stamp_[neighbor] == stamp_ || (ids[neighbor] != a && ids[neighbor] != b)) continue;
            face_stamp_[neighbor] = stamp_;
            sources_.push_back(neighbor);
          }
      }
    }
    if (sources_.empty()) return false;
    for (int f : band_) node_[f] = -1;
    distance_.Run(
        sources_, [&](int f) { return ids[f] == a || ids[f] == b; },
        std::max(depth, pricing_.Reach() * unit_length_));
    band_.clear();
    for (int f : distance_.Reached())
      if (distance_[f] <= depth) band_.push_back(f);
    for (size_t k = 0; k < band_.size(); ++k) node_[band_[k]] = static_cast<int>(k);
    pricing_.Prepare(a, b, distance_.Reached(), band_, ids);
    return true;
  }

  // Whole multiples of a small unit: sums are exact, and what is equally good stays so in any order.
  static double Exactly(double price) {
    constexpr double kUnitsPerPrice = 1e12;
    return std::round(price * kUnitsPerPrice);
  }

  double PriceOfEdge(int h) const {
    return Exactly(options_.length_weight * crease_weight_[h] * surface_.Length(h) / unit_length_);
  }

  // The prices of the cut: side true is chart a.
  void PriceBand(int a, int b, const ChartIds& ids) {
    // Equal ways are many on planes, and circles there would shrink: to change a face's chart costs as much
    // as a border with a radius of the surface's size wins.
    const double change_weight = options_.length_weight;
    const size_t count = band_.size();
    pull_.assign(count, 0);
    was_a_.assign(count, false);
    anchored_.assign(count, false);
    edges_.clear();
    std::array<bool, 2> reaches_out{false, false};  // chart a, chart b
    for (size_t k = 0; k < count; ++k) {
      const int f = band_[k];
      was_a_[k] = ids[f] == a;
      const double area = surface_.Area(f) / unit_area_;
      const double stay = was_a_[k] ? change_weight : -change_weight;
      pull_[k] += Exactly(area * (pricing_(static_cast<int>(k)) + stay));
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h);
        if (g < 0 || (ids[g] != a && ids[g] != b)) continue;
        if (node_[g] >= 0) {
          if (f < g) edges_.push_back({static_cast<int>(k), node_[g], PriceOfEdge(h)});
          continue;
        }
        pull_[k] += ids[g] == a ? PriceOfEdge(h) : -PriceOfEdge(h);
        anchored_[k] = true;  // to the rest of its chart
        reaches_out[ids[g] == a ? 0 : 1] = true;
      }
    }
    for (int side : {0, 1})
      if (!reaches_out[side]) FixDeepest(side == 0);
  }

  // A chart that is all in the band keeps at least the face farthest from the border, of several the one that
  // fits it best.
  void FixDeepest(bool of_a) {
    auto rank = [&](int k) {
      return std::tuple(distance_[band_[k]], of_a ? pull_[k] : -pull_[k], -band_[k]);
    };
    int deepest = -1;
    for (int k = 0; k < static_cast<int>(band_.size()); ++k)
      if (was_a_[k] == of_a && (deepest < 0 || rank(k) > rank(deepest))) deepest = k;
    if (deepest < 0) return;
    constexpr double kProhibitive = 1e14;  // no cut costs as much
    pull_[deepest] = of_a ? kProhibitive : -kProhibitive;
    anchored_[deepest] = true;
  }

  // Parts of a chart that hang together with the rest of it nowhere go to the other chart.
  void DropIslands(int a, int b) {
    for (int chart : {a, b}) {
      const bool wanted = chart == a;
      component_.assign(band_.size(), -1);
      for (int start = 0; start < static_cast<int>(band_.size()); ++start) {
        if (component_[start] >= 0 || side_[start] != wanted) continue;
        bool anchored = false;
        const auto& members = Flood(start, [&](int k) { return side_[k] == wanted; });
        // The anchor of a face is to the chart that it had.
        for (int k : members) anchored = anchored || (anchored_[k] && was_a_[k] == wanted);
        if (!anchored)
          for (int k : members) side_[k] = !wanted;
      }
    }
  }

  // The nodes that hang together with `start` over nodes that `belongs` takes; marked in component_.
  template <class Belongs>
  const std::vector<int>& Flood(int start, const Belongs& belongs) {
    members_.assign(1, start);
    component_[start] = start;
    for (size_t k = 0; k < members_.size(); ++k) {
      const int f = band_[members_[k]];
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h);
        const int n = g < 0 ? -1 : node_[g];
        if (n < 0 || component_[n] >= 0 || !belongs(n)) continue;
        component_[n] = start;
        members_.push_back(n);
      }
    }
    return members_;
  }

  // Changes that hang together stand or fall together, others on their own, the best first.
  Outcome ApplyCut(int a, int b, ChartIds& ids) {
    struct Group {
      double gain;
      std::vector<int> nodes;
    };
    std::vector<Group> groups;
    component_.assign(band_.size(), -1);
    for (int start = 0; start < static_cast<int>(band_.size()); ++start) {
      if (component_[start] >= 0 || side_[start] == was_a_[start]) continue;
      const auto& nodes = Flood(start, [&](int k) { return side_[k] != was_a_[k]; });
      const double gain = GainOf(nodes, ids);
      if (gain > 0) groups.push_back({gain, nodes});
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& x, const Group& y) { return x.gain > y.gain; });
    Outcome outcome = Outcome::kDone;
    std::vector<int> applied;
    double gain = 0;
    for (const Group& group : groups) {
      if (ApplyGroup(group.nodes, a, b, ids)) {
        applied.insert(applied.end(), group.nodes.begin(), group.nodes.end());
        gain += group.gain;
      } else {
        outcome = Outcome::kRefused;
      }
    }
    if (applied.empty()) return outcome;
    if (!IsWhole(a, ids) || !IsWhole(b, ids)) {
      for (int k : applied) Move(band_[k], was_a_[k] ? a : b, ids);
      return Outcome::kRefused;
    }
    gain_ += gain / Exactly(1);
    return outcome;
  }

  double GainOf(const std::vector<int>& group, const ChartIds& ids) const {
    double gain = 0;
    for (int k : group) gain += was_a_[k] ? -pull_[k] : pull_[k];
    for (int k : group) {
      const int f = band_[k];
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h);
        if (g < 0 || node_[g] < 0) continue;
        const bool with_us = component_[node_[g]] == component_[k];
        if (with_us && g < f) continue;
        const bool parted = ids[f] != ids[g];
        const bool to_be_parted = side_[k] != (with_us ? side_[node_[g]] : was_a_[node_[g]]);
        gain += PriceOfEdge(h) * (static_cast<int>(parted) - static_cast<int>(to_be_parted));
      }
    }
    return gain;
  }

  bool ApplyGroup(const std::vector<int>& group, int a, int b, ChartIds& ids) {
    std::vector<int> faces;
    for (int k : group) faces.push_back(band_[k]);
    const int before_a = topology_.EulerPart(faces, a, ids), before_b = topology_.EulerPart(faces, b, ids);
    for (int k : group) Move(band_[k], side_[k] ? a : b, ids);
    const int after_a = topology_.EulerPart(faces, a, ids), after_b = topology_.EulerPart(faces, b, ids);
    constexpr double kLeastShare = 0.5;
    const bool good =
        after_a >= before_a && after_b >= before_b && charts_[a].area >= kLeastShare * area_at_start_[a] &&
        charts_[b].area >= kLeastShare * area_at_start_[b] && (after_a == before_a || Connected(a, ids)) &&
        (after_b == before_b || Connected(b, ids));
    if (!good)
      for (int k : group) Move(band_[k], was_a_[k] ? a : b, ids);
    return good;
  }

  void Move(int f, int chart, ChartIds& ids) {
    Chart &from = charts_[ids[f]], &to = charts_[chart];
    --from.face_count;
    from.area -= surface_.Area(f);
    ++to.face_count;
    to.area += surface_.Area(f);
    to.faces.push_back(f);
    ids[f] = chart;
  }

  // A chart whose faces in the band hang together is whole: it was before, and the rest has not changed.
  bool IsWhole(int chart, const ChartIds& ids) {
    component_.assign(band_.size(), -1);
    int pieces = 0;
    for (int k = 0; k < static_cast<int>(band_.size()); ++k) {
      if (component_[k] >= 0 || ids[band_[k]] != chart) continue;
      if (++pieces > 1) return Connected(chart, ids);
      Flood(k, [&](int n) { return ids[band_[n]] == chart; });
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
  const double unit_area_, unit_length_;
  const std::vector<double> crease_weight_;
  DualDistance<MeshType> distance_;
  ChartTopology<MeshType> topology_;
  std::vector<Chart> charts_;
  std::vector<double> area_at_start_;
  double gain_ = 0;  // of the present sweep, in the price of the cut

  // The band of the present pair: its faces are the nodes 0, 1... of the flow network.
  std::vector<int> face_stamp_, sources_, band_;
  std::vector<int> node_;  // per face, -1 outside the band
  std::vector<double> pull_;
  std::vector<FlowEdge> edges_;
  std::vector<bool> was_a_, side_, anchored_;
  std::vector<int> component_, members_;
  int stamp_ = 0;
};

}  // namespace dcharts
