// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "common/params.h"
#include "common/pi.h"
#include "planar/cone_proxy.h"
#include "surface/charts.h"
#include "surface/seeds.h"
#include "surface/surface_graph.h"

namespace dcharts {

/// Grows charts face by face, cheapest first (Section 3.1, "Growing Charts"), cost F^alpha C^beta P^gamma
/// (Eq. 2).
///
/// One queue per chart. A chart's area scales all costs in its queue alike (A_C^-beta), so it is kept as one
/// factor per chart; D and P change when a neighbour joins, so a face is pushed again on every new contact
/// and entries whose contacts are out of date are skipped.
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
        distance_(surface.FaceCount(), 0) {}

  /// Grows every chart from its seed over the unassigned faces of `ids` with F < `bound`. Two charts with one
  /// seed: the later gets nothing. Faces that already have a chart keep it and are not grown from.
  void FromSeeds(const std::vector<GrowingChart>& charts, double bound, ChartIds& ids) {
    FromSeeds(charts, 0, bound, ids);
  }

  /// The same for charts whose ids start at `first_id`.
  void FromSeeds(const std::vector<GrowingChart>& charts, int first_id, double bound, ChartIds& ids) {
    Begin(charts, first_id, bound, ids);
    for (int c = 0; c < static_cast<int>(charts.size()); ++c)
      if (ids[charts[c].seed] == kUnassigned) Assign(c, charts[c].seed, 0);
    GrowAll();
  }

  /// Grows the charts that already hold faces into the unassigned ones. `distance` is D(S,t) of the assigned
  /// faces.
  void IntoHoles(const std::vector<GrowingChart>& charts, double bound, const std::vector<double>& distance,
                 ChartIds& ids) {
    Begin(charts, 0, bound, ids);
    distance_ = distance;
    for (int f = 0; f < surface_.FaceCount(); ++f)
      if (ids[f] >= 0) area_[ids[f]] += surface_.Area(f);
    for (int f = 0; f < surface_.FaceCount(); ++f)
      if (ids[f] >= 0) PushNeighbours(ids[f], f);
    for (int c = 0; c < static_cast<int>(charts.size()); ++c) Refresh(c);
    GrowAll();
  }

 private:
  struct Entry {
    double cost;  // without the chart's factor A_C^-beta
    double distance;
    int face;
    int contacts;                               // edges shared with the chart when pushed, as a bit mask
    bool operator<(const Entry& other) const {  // for a heap with the cheapest on top
      return cost != other.cost ? cost > other.cost : face > other.face;
    }
  };

  void Begin(const std::vector<GrowingChart>& charts, int first_id, double bound, ChartIds& ids) {
    charts_ = &charts;
    first_id_ = first_id;
    bound_ = bound;
    ids_ = &ids;
    area_.assign(charts.size(), 0);
    queues_.resize(charts.size());
    for (auto& queue : queues_) queue.clear();
    leaves_ = 1;
    while (leaves_ < static_cast<int>(charts.size())) leaves_ *= 2;
    best_.assign(2 * leaves_, -1);
    key_.assign(charts.size(), kNoBound);
  }

  void GrowAll() {
    constexpr int kPollEvery = 65536;
    for (int step = 0; !key_.empty() && best_[1] >= 0; ++step) {
      if (poll_ && step % kPollEvery == 0) poll_();
      const int c = best_[1];
      auto& queue = queues_[c];
      if (Stale(c, queue.front())) {  // another chart took the face meanwhile
        Refresh(c);
        continue;
      }
      const Entry entry = queue.front();
      std::pop_heap(queue.begin(), queue.end());
      queue.pop_back();
      Assign(c, entry.face, entry.distance);
    }
  }

  void Assign(int c, int face, double distance) {
    (*ids_)[face] = first_id_ + c;
    distance_[face] = distance;
    area_[c] += surface_.Area(face);
    PushNeighbours(c, face);
    Refresh(c);
  }

  int Contacts(int c, int face) const {
    int contacts = 0;
    for (int i = 0; i < 3; ++i) {
      const int g = surface_.Neighbour(3 * face + i);
      if (g >= 0 && (*ids_)[g] == first_id_ + c) contacts |= 1 << i;
    }
    return contacts;
  }

  void PushNeighbours(int c, int face) {
    const ConeProxy& proxy = (*charts_)[c].proxy;
    for (int h = 3 * face; h < 3 * face + 3; ++h) {
      const int g = surface_.Neighbour(h);
      if (g < 0 || (*ids_)[g] != kUnassigned) continue;
      const double error = FittingError(proxy, surface_.Normal(g));
      if (!(error < bound_)) continue;
      Entry entry{0, kNoBound, g, Contacts(c, g)};
      double inner = 0, outer = 0;
      for (int i = 0; i < 3; ++i) {
        const int k = 3 * g + i;
        if (entry.contacts >> i & 1) {
          inner += surface_.Length(k);
          entry.distance = std::min(entry.distance, distance_[surface_.Neighbour(k)] + surface_.Step(k));
        } else {
          outer += surface_.Length(k);
        }
      }
      // An F of 0 would make every cost 0 and the order arbitrary.
      constexpr double kFloor = 1e-3;
      const double straightness = inner > 0 ? outer / inner : (outer > 0 ? 1e6 : 0);
      entry.cost = Power(error + kFloor, alpha_) * Power(kPi * entry.distance * entry.distance, beta_) *
                   Power(straightness, gamma_);
      queues_[c].push_back(entry);
      std::push_heap(queues_[c].begin(), queues_[c].end());
    }
  }

  // Most weights are 1.
  static double Power(double base, double exponent) {
    return exponent == 1 ? base : std::pow(base, exponent);
  }

  bool Stale(int c, const Entry& entry) const {
    return (*ids_)[entry.face] != kUnassigned || Contacts(c, entry.face) != entry.contacts;
  }

  // Drops what is stale from the top of chart c's queue and puts its cost into the tree of all charts' tops.
  void Refresh(int c) {
    auto& queue = queues_[c];
    while (!queue.empty() && Stale(c, queue.front())) {
      std::pop_heap(queue.begin(), queue.end());
      queue.pop_back();
    }
    constexpr double kTiny = 1e-30;  // a seed without area
    key_[c] = queue.empty() ? kNoBound : queue.front().cost * std::pow(std::max(area_[c], kTiny), -beta_);
    int node = leaves_ + c;
    best_[node] = queue.empty() ? -1 : c;
    for (node /= 2; node >= 1; node /= 2) {
      const int left = best_[2 * node], right = best_[2 * node + 1];
      best_[node] = right < 0 || (left >= 0 && key_[left] <= key_[right]) ? left : right;
    }
  }

  const SurfaceGraph<MeshType>& surface_;
  const std::function<void()> poll_;
  double alpha_, beta_, gamma_;
  std::vector<double> distance_;  // D(S,t)
  const std::vector<GrowingChart>* charts_ = nullptr;
  ChartIds* ids_ = nullptr;
  int first_id_ = 0;
  double bound_ = 0;
  std::vector<double> area_;
  std::vector<std::vector<Entry>> queues_;
  int leaves_ = 1;
  std::vector<int> best_;    // binary tree over the charts: which has the cheapest top
  std::vector<double> key_;  // cost of each chart's top
};

}  // namespace dcharts
