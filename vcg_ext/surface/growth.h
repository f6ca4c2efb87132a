// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "common/cheapest_first.h"
#include "common/params.h"
#include "common/pi.h"
#include "common/tournament.h"
#include "planar/cone_proxy.h"
#include "surface/charts.h"
#include "surface/seeds.h"
#include "surface/surface_graph.h"

namespace dcharts {

/// Grows charts face by face, cheapest first (Section 3.1, "Growing Charts"), cost F^alpha C^beta P^gamma
/// (Eq. 2).
///
/// One queue per chart. A chart's area scales all costs in its queue alike (A_C^-beta), so it is kept as one
/// factor per chart. D and P change when a neighbour joins, so a face is pushed again on every new contact;
/// as both only get less by that, the last entry is the first to be taken, and the others are stale then.
template <class MeshType>
class Growth {
 public:
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();

  /// `poll` is called now and then and may throw.
  Growth(const SurfaceGraph<MeshType>& surface, const Params& params, std::function<void()> poll = {})
      : surface_(surface),
        poll_(std::move(poll)),
        alpha_(params.fitting_weight),
        beta_(params.compactness_weight),
        gamma_(params.straightness_weight),
        contacts_(surface.FaceCount()) {}

  /// Grows every chart from its seed over the unassigned faces of `ids` with F < `bound`. Two charts with one
  /// seed: the later gets nothing. Faces that already have a chart keep it and are not grown from.
  void FromSeeds(const std::vector<GrowingChart>& charts, double bound, ChartIds& ids) {
    FromSeeds(charts, 0, bound, ids);
  }

  /// The same for charts whose ids start at `first_id`.
  void FromSeeds(const std::vector<GrowingChart>& charts, int first_id, double bound, ChartIds& ids) {
    Begin(charts, first_id, bound, ids);
    for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
      if (ids[charts[c].seed] != kUnassigned) continue;
      Take(c, charts[c].seed);
      Push(c, NeighboursOf(c, charts[c].seed, 0));
    }
    GrowAll();
  }

  /// Grows the charts that already hold faces into the unassigned ones. `distance` is D(S,t) of the assigned
  /// faces.
  void IntoHoles(const std::vector<GrowingChart>& charts, double bound, const std::vector<double>& distance,
                 ChartIds& ids) {
    Begin(charts, 0, bound, ids);
    for (int f = 0; f < surface_.FaceCount(); ++f)
      if (ids[f] >= 0) area_[ids[f]] += surface_.Area(f);
    for (int f = 0; f < surface_.FaceCount(); ++f)
      if (ids[f] >= 0) Push(ids[f], NeighboursOf(ids[f], f, distance[f]));
    GrowAll();
  }

 private:
  // Of faces. Costs are without the chart's factor A_C^-beta.
  using Queue = CheapestFirst<int>;

  // What a face's neighbours leave with it when a chart takes them.
  struct Contacts {
    std::array<double, 3> distance;        // D(S,t) of the face by way of edge i
    std::array<int, 3> chart{-1, -1, -1};  // beyond edge i: a chart's stamp

    double Distance(int stamp) const {
      double least = kNoBound;
      for (int i = 0; i < 3; ++i) least = std::min(least, chart[i] == stamp ? distance[i] : kNoBound);
      return least;
    }
  };

  // Entries for the neighbours of a face: at most three.
  struct Entries {
    std::array<Queue::Entry, 3> entry;
    int count = 0;
  };

  void Begin(const std::vector<GrowingChart>& charts, int first_id, double bound, ChartIds& ids) {
    charts_ = &charts;
    first_id_ = first_id;
    bound_ = bound;
    ids_ = &ids;
    const int count = static_cast<int>(charts.size());
    // Stamps of every run are new: contacts of earlier runs say nothing.
    first_stamp_ = next_stamp_;
    if (first_stamp_ > std::numeric_limits<int>::max() - count) {
      contacts_.assign(contacts_.size(), {});
      first_stamp_ = 0;
    }
    next_stamp_ = first_stamp_ + count;
    area_.assign(count, 0);
    factor_.assign(count, 0);
    queues_.resize(count);
    for (auto& queue : queues_) queue.Clear();
  }

  void GrowAll() {
    tournament_.Begin(static_cast<int>(queues_.size()));
    for (int c = 0; c < static_cast<int>(queues_.size()); ++c)
      if (DropStale(c)) tournament_.Enter(c, Key(c));
    tournament_.Start();
    constexpr int kPollEvery = 65536;
    for (int step = 0; tournament_.Winner() != Tournament::kNobody; ++step) {
      if (poll_ && step % kPollEvery == 0) poll_();
      const int c = tournament_.Winner();
      const int face = queues_[c].Top().item;
      if (IsFree(face)) {  // else another chart took it meanwhile
        Take(c, face);
        ReplaceTop(c, NeighboursOf(c, face, contacts_[face].Distance(first_stamp_ + c)));
      }
      if (!DropStale(c))
        tournament_.Leave();
      else if (!tournament_.WinsAgain(MostKey(c)))
        tournament_.Replay(Key(c));
    }
  }

  void Take(int c, int face) {
    (*ids_)[face] = first_id_ + c;
    area_[c] += surface_.Area(face);
  }

  // What becomes of the neighbours of a face that chart c has, at `distance` from its seed.
  Entries NeighboursOf(int c, int face, double distance) {
    const ConeProxy& proxy = (*charts_)[c].proxy;
    const int stamp = first_stamp_ + c;
    Entries entries;
    for (int h = 3 * face; h < 3 * face + 3; ++h) {
      const int o = surface_.Opposite(h);
      if (o < 0) continue;
      const int g = o / 3;
      if (!IsFree(g)) continue;
      Contacts& contacts = contacts_[g];
      contacts.chart[o - 3 * g] = stamp;
      contacts.distance[o - 3 * g] = distance + surface_.Step(h);
      const double error = FittingError(proxy, surface_.Normal(g));
      if (!(error < bound_)) continue;
      entries.entry[entries.count++] = {Cost(error, stamp, g), g};
    }
    return entries;
  }

  double Cost(double error, int stamp, int face) const {
    const Contacts& contacts = contacts_[face];
    double inner = 0, outer = 0;
    for (int i = 0; i < 3; ++i) {
      const double length = surface_.Length(3 * face + i);
      const bool is_inner = contacts.chart[i] == stamp;
      inner += is_inner ? length : 0;
      outer += is_inner ? 0 : length;
    }
    // An F of 0 would make every cost 0 and the order arbitrary.
    constexpr double kFloor = 1e-3;
    const double straightness = inner > 0 ? outer / inner : (outer > 0 ? 1e6 : 0);
    const double distance = contacts.Distance(stamp);
    return Power(error + kFloor, alpha_) * Power(kPi * distance * distance, beta_) *
           Power(straightness, gamma_);
  }

  // Most weights are 1.
  static double Power(double base, double exponent) {
    return exponent == 1 ? base : std::pow(base, exponent);
  }

  void Push(int c, const Entries& entries) {
    for (int k = 0; k < entries.count; ++k) queues_[c].Push(entries.entry[k]);
  }

  void ReplaceTop(int c, const Entries& entries) {
    if (entries.count == 0) {
      queues_[c].Pop();
      return;
    }
    queues_[c].ReplaceTop(entries.entry[0]);
    for (int k = 1; k < entries.count; ++k) queues_[c].Push(entries.entry[k]);
  }

  bool IsFree(int face) const { return (*ids_)[face] == kUnassigned; }

  // From the top of chart c's queue; false when nothing is left.
  bool DropStale(int c) {
    Queue& queue = queues_[c];
    while (!queue.IsEmpty() && !IsFree(queue.Top().item)) queue.Pop();
    return !queue.IsEmpty();
  }

  // What the top of chart c's queue costs.
  double Key(int c) {
    constexpr double kTiny = 1e-30;  // a seed without area
    factor_[c] = std::pow(std::max(area_[c], kTiny), -beta_);
    return queues_[c].Top().cost * factor_[c];
  }

  // No less than Key(c), and without its power: areas only grow, so factors only get less.
  double MostKey(int c) const {
    constexpr double kRounding = 1 + 1e-9;
    return queues_[c].Top().cost * factor_[c] * kRounding;
  }

  const SurfaceGraph<MeshType>& surface_;
  const std::function<void()> poll_;
  double alpha_, beta_, gamma_;
  std::vector<Contacts> contacts_;  // of each face
  int first_stamp_ = 0, next_stamp_ = 0;
  const std::vector<GrowingChart>* charts_ = nullptr;
  ChartIds* ids_ = nullptr;
  int first_id_ = 0;
  double bound_ = 0;
  std::vector<double> area_, factor_;  // of each chart; factors may be those of an area of earlier
  std::vector<Queue> queues_;
  Tournament tournament_;  // of the charts, by their cheapest faces
};

}  // namespace dcharts
