// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "planar/extend_map.h"
#include "surface/chart_maps.h"
#include "surface/charts.h"

namespace dcharts {

/// What the faces of one chart in a band would cost as faces of the chart beyond the border, whose map is
/// continued over them.
template <class MeshType>
class GuestPricing {
 public:
  static constexpr double kProhibitive = 1e3;  ///< no face is stretched like this

  explicit GuestPricing(const SurfaceGraph<MeshType>& surface)
      : surface_(surface), local_(surface.VertexCount(), -1), in_collar_(surface.FaceCount(), false) {}

  /// Sets the prices of the faces of `guest` in the band, as MapPricing has them. `sign`: 1 when the host is
  /// the pair's chart a, else -1.
  void Price(const ChartMaps<MeshType>& maps, int host, int guest, const std::vector<int>& band,
             const ChartIds& ids, double sign, std::vector<double>& price) {
    guests_.clear();
    faces_.clear();
    vertices_.clear();
    for (int k = 0; k < static_cast<int>(band.size()); ++k) {
      if (ids[band[k]] != guest) continue;
      if (!maps.Hold(band[k], guest, ids)) {
        price[k] = -sign * kProhibitive;
        continue;
      }
      guests_.push_back(k);
      AddFace(band[k]);
    }
    AddCollar(maps, host, band, ids);
    MapEdge edge = ReadEdge(maps, host, ids);
    const std::vector<double> excess = ExtendMap(edge);
    // What the guests cost the faces that make room for them is theirs to pay.
    double of_guests = 0, of_collar = 0;
    for (int t = 0; t < static_cast<int>(faces_.size()); ++t) {
      if (!(excess[t] < kProhibitive)) continue;
      const bool is_guest = t < static_cast<int>(guests_.size());
      const double more = is_guest ? excess[t] : excess[t] - maps.Excess(faces_[t]);
      (is_guest ? of_guests : of_collar) += surface_.Area(faces_[t]) * more;
    }
    const double share = of_guests > 0 ? 1 + std::max(0.0, of_collar) / of_guests : 1;
    for (int t = 0; t < static_cast<int>(guests_.size()); ++t) {
      const double gain = TouchesTear(t) ? -kProhibitive : maps.Excess(faces_[t]) - share * excess[t];
      price[guests_[t]] = sign * std::clamp(gain, -kProhibitive, kProhibitive);
    }
    for (int f : faces_) in_collar_[f] = false;
    for (int v : vertices_) local_[v] = -1;
  }

 private:
  void AddFace(int f) {
    faces_.push_back(f);
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      int& local = local_[surface_.Vertex(h)];
      if (local >= 0) continue;
      local = static_cast<int>(vertices_.size());
      vertices_.push_back(surface_.Vertex(h));
    }
  }

  // The host's own faces in the band may make room, except where a cut through the host ends.
  void AddCollar(const ChartMaps<MeshType>& maps, int host, const std::vector<int>& band,
                 const ChartIds& ids) {
    const size_t guests = faces_.size();
    for (int f : band)
      if (maps.Hold(f, host, ids)) AddFace(f);
    torn_.assign(vertices_.size(), false);
    for (size_t v = 0; v < vertices_.size(); ++v) {
      int first = -1;
      for (const int* r = surface_.RingBegin(vertices_[v]); r != surface_.RingEnd(vertices_[v]); ++r) {
        if (!maps.Hold(*r / 3, host, ids)) continue;
        if (first >= 0 && maps.At(first) != maps.At(*r)) torn_[v] = true;
        first = *r;
      }
    }
    size_t kept = guests;
    for (size_t t = guests; t < faces_.size(); ++t)
      if (!TouchesTear(static_cast<int>(t))) faces_[kept++] = faces_[t];
    faces_.resize(kept);
    for (size_t t = guests; t < kept; ++t) in_collar_[faces_[t]] = true;
  }

  bool TouchesTear(int t) const {
    for (int h = 3 * faces_[t]; h < 3 * faces_[t] + 3; ++h)
      if (torn_[local_[surface_.Vertex(h)]]) return true;
    return false;
  }

  MapEdge ReadEdge(const ChartMaps<MeshType>& maps, int host, const ChartIds& ids) const {
    MapEdge edge;
    edge.mesh.triangles.resize(static_cast<int>(faces_.size()), 3);
    for (int t = 0; t < static_cast<int>(faces_.size()); ++t)
      for (int i = 0; i < 3; ++i) edge.mesh.triangles(t, i) = local_[surface_.Vertex(3 * faces_[t] + i)];
    const size_t count = vertices_.size();
    edge.mesh.positions.resize(static_cast<int>(count), 3);
    edge.placed.assign(count, false);
    edge.fixed.assign(count, false);
    edge.uv.resize(count);
    for (size_t v = 0; v < count; ++v) {
      edge.mesh.positions.row(static_cast<int>(v)) = surface_.Position(vertices_[v]);
      for (const int* r = surface_.RingBegin(vertices_[v]); r != surface_.RingEnd(vertices_[v]); ++r) {
        if (!maps.Hold(*r / 3, host, ids)) continue;
        edge.placed[v] = true;
        edge.uv[v] = maps.At(*r);
        if (!in_collar_[*r / 3]) edge.fixed[v] = true;
      }
    }
    return edge;
  }

  const SurfaceGraph<MeshType>& surface_;
  std::vector<int> guests_;      // in the band
  std::vector<int> faces_;       // the guests, then the collar
  std::vector<int> vertices_;    // of those
  std::vector<int> local_;       // per vertex of the surface: its place in vertices_
  std::vector<bool> torn_;       // per vertex in vertices_: in several places on the host's map
  std::vector<char> in_collar_;  // per face
};

}  // namespace dcharts
