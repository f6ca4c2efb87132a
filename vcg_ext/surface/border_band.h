// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "planar/min_cut.h"
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

/// A chart while its borders move.
struct MovingChart {
  std::vector<int> faces;  // may hold faces that have left, and some twice
  int face_count = 0;
  double area = 0;
};

/// The faces near the common border of charts a and b, dealt out anew.
struct BorderBand {
  std::vector<int> faces;  ///< none when the two have no common border
  std::vector<double> pull;
  std::vector<bool> was_a, is_a;
};

/// Prices are whole multiples of a small unit: sums are exact, and what is equally good stays so in any
/// order.
inline double InUnits(double price) {
  constexpr double kUnitsPerPrice = 1e12;
  return std::round(price * kUnitsPerPrice);
}

/// What borders cost along edges.
template <class MeshType>
class BorderPrices {
 public:
  BorderPrices(const SurfaceGraph<MeshType>& surface, double length_weight)
      : surface_(surface),
        length_weight_(length_weight),
        unit_length_(std::sqrt(surface.TotalArea())),
        crease_weight_(CreaseWeights(surface)) {}

  /// Less on creases.
  double Length(int h) const { return crease_weight_[h] * surface_.Length(h) / unit_length_; }
  double OfEdge(int h) const {
    return InUnits(length_weight_ * crease_weight_[h] * surface_.Length(h) / unit_length_);
  }

 private:
  const SurfaceGraph<MeshType>& surface_;
  const double length_weight_, unit_length_;
  const std::vector<double> crease_weight_;
};

/// The faces of one band as nodes 0, 1...
template <class MeshType>
class BandNodes {
 public:
  explicit BandNodes(const SurfaceGraph<MeshType>& surface)
      : surface_(surface), node_(surface.FaceCount(), -1) {}

  void Set(const std::vector<int>& faces) {
    for (int f : faces_) node_[f] = -1;
    faces_ = faces;
    for (size_t k = 0; k < faces_.size(); ++k) node_[faces_[k]] = static_cast<int>(k);
  }
  int operator[](int face) const { return node_[face]; }  ///< -1 outside the band

  void ForgetComponents() { component_.assign(faces_.size(), -1); }
  int Component(int node) const { return component_[node]; }  ///< where its Flood began, -1 before

  /// The nodes that hang together with `start` over nodes that `belongs` takes.
  template <class Belongs>
  const std::vector<int>& Flood(int start, const Belongs& belongs) {
    members_.assign(1, start);
    component_[start] = start;
    for (size_t k = 0; k < members_.size(); ++k) {
      const int f = faces_[members_[k]];
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

 private:
  const SurfaceGraph<MeshType>& surface_;
  std::vector<int> faces_, node_, component_, members_;
};

/// Finds the best border of two charts by a graph cut, see BorderGraphCut. Reads nothing of other charts:
/// pairs without a chart in common don't mind each other.
template <class MeshType, class Pricing>
class BorderBander {
 public:
  /// All but `pricing`, which is copied, must outlive this object.
  BorderBander(const SurfaceGraph<MeshType>& surface, const BorderCutOptions& options,
               const BorderPrices<MeshType>& prices, const Pricing& pricing)
      : surface_(surface),
        options_(options),
        prices_(prices),
        pricing_(pricing),
        unit_area_(surface.TotalArea()),
        unit_length_(std::sqrt(surface.TotalArea())),
        distance_(surface),
        node_(surface),
        face_stamp_(surface.FaceCount(), 0) {}

  /// `width`: in place of options.band.
  BorderBand Cut(int a, int b, double width, const std::vector<MovingChart>& charts, const ChartIds& ids,
                 const std::function<void()>& poll) {
    poll();
    band_ = {};
    Collect(a, b, width, charts, ids);
    if (band_.faces.empty()) return {};
    poll();
    Price(a, b, ids);
    poll();
    band_.is_a = BandedMinCut(band_.pull, edges_, poll);
    DropIslands();
    return std::move(band_);
  }

 private:
  // The faces of both charts near their common border.
  void Collect(int a, int b, double width, const std::vector<MovingChart>& charts, const ChartIds& ids) {
    constexpr double kDepth = 0.25;  // of the smaller chart's size
    const double depth =
        std::min(width * unit_length_, kDepth * std::sqrt(std::min(charts[a].area, charts[b].area)));
    const auto [small, large] =
        charts[a].face_count <= charts[b].face_count ? std::pair(a, b) : std::pair(b, a);
    sources_.clear();
    ++stamp_;
    for (int f : charts[small].faces) {
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
    if (sources_.empty()) return;
    distance_.Run(
        sources_, [&](int f) { return ids[f] == a || ids[f] == b; },
        std::max(depth, pricing_.Reach() * unit_length_));
    for (int f : distance_.Reached())
      if (distance_[f] <= depth) band_.faces.push_back(f);
    node_.Set(band_.faces);
    pricing_.Prepare(a, b, distance_.Reached(), band_.faces, ids);
  }

  // The prices of the cut: side true is chart a.
  void Price(int a, int b, const ChartIds& ids) {
    // Equal ways are many on planes, and circles there would shrink: to change a face's chart costs as much
    // as a border with a radius of the surface's size wins.
    const double change_weight = options_.length_weight;
    const size_t count = band_.faces.size();
    band_.pull.assign(count, 0);
    band_.was_a.assign(count, false);
    anchored_.assign(count, false);
    edges_.clear();
    std::array<bool, 2> reaches_out{false, false};  // chart a, chart b
    for (size_t k = 0; k < count; ++k) {
      const int f = band_.faces[k];
      band_.was_a[k] = ids[f] == a;
      const double area = surface_.Area(f) / unit_area_;
      const double stay = band_.was_a[k] ? change_weight : -change_weight;
      band_.pull[k] += InUnits(area * (pricing_(static_cast<int>(k)) + stay));
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h);
        if (g < 0 || (ids[g] != a && ids[g] != b)) continue;
        if (node_[g] >= 0) {
          if (f < g) edges_.push_back({static_cast<int>(k), node_[g], prices_.OfEdge(h)});
          continue;
        }
        band_.pull[k] += ids[g] == a ? prices_.OfEdge(h) : -prices_.OfEdge(h);
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
      return std::tuple(distance_[band_.faces[k]], of_a ? band_.pull[k] : -band_.pull[k], -band_.faces[k]);
    };
    int deepest = -1;
    for (int k = 0; k < static_cast<int>(band_.faces.size()); ++k)
      if (band_.was_a[k] == of_a && (deepest < 0 || rank(k) > rank(deepest))) deepest = k;
    if (deepest < 0) return;
    constexpr double kProhibitive = 1e14;  // no cut costs as much
    band_.pull[deepest] = of_a ? kProhibitive : -kProhibitive;
    anchored_[deepest] = true;
  }

  // Parts of a chart that hang together with the rest of it nowhere go to the other chart.
  void DropIslands() {
    std::vector<bool>& side = band_.is_a;
    for (const bool wanted : {true, false}) {
      node_.ForgetComponents();
      for (int start = 0; start < static_cast<int>(side.size()); ++start) {
        if (node_.Component(start) >= 0 || side[start] != wanted) continue;
        bool anchored = false;
        const auto& members = node_.Flood(start, [&](int k) { return side[k] == wanted; });
        // The anchor of a face is to the chart that it had.
        for (int k : members) anchored = anchored || (anchored_[k] && band_.was_a[k] == wanted);
        if (!anchored)
          for (int k : members) side[k] = !wanted;
      }
    }
  }

  const SurfaceGraph<MeshType>& surface_;
  const BorderCutOptions& options_;
  const BorderPrices<MeshType>& prices_;
  Pricing pricing_;
  const double unit_area_, unit_length_;
  DualDistance<MeshType> distance_;
  BandNodes<MeshType> node_;
  std::vector<int> face_stamp_, sources_;
  int stamp_ = 0;
  BorderBand band_;  // its faces are the nodes of the flow network
  std::vector<FlowEdge> edges_;
  std::vector<bool> anchored_;
};

}  // namespace dcharts
