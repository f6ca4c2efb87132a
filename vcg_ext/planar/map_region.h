// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"
#include "planar/distortion.h"
#include "planar/rest_shapes.h"
#include "planar/vertex_block_system.h"

namespace dcharts {

/// Some triangles of a chart, to change its map in while the rest of it stays: what takes many steps takes as
/// many times less work as there are fewer of them.
class MapRegion {
 public:
  /// The vertices v with `moves[v]` (one at least), and the triangles at them. `chart` must be normalized and
  /// outlive this, as `system` must, the one of all of its triangles: it serves where all vertices move.
  MapRegion(const ChartMesh& chart, const RestShapes& shapes, const PlanePoints& uv,
            const std::vector<char>& moves, VertexBlockSystem& system);
  MapRegion(const MapRegion&) = delete;

  bool IsWhole() const { return !own_system_; }  ///< all vertices move
  const Triangles& LocalTriangles() const { return triangles_; }
  const RestShapes& Shapes() const { return shapes_; }
  VertexBlockSystem& System() { return own_system_ ? *own_system_ : system_; }
  const PlanePoints& Uv() const { return uv_; }  ///< as it was

  /// Of the whole chart, with these for Uv().
  StretchFigures Measure(const PlanePoints& uv) const;
  /// Puts these in the place of Uv().
  void Write(const PlanePoints& uv, PlanePoints& of_chart) const;

 private:
  void Add(int face, const Complex (&corner)[3], StretchFigures& figures) const;

  const ChartMesh& chart_;
  VertexBlockSystem& system_;
  double area_floor_;  // see StretchFigures
  std::vector<int> vertices_, faces_;
  Triangles triangles_;
  RestShapes shapes_;
  PlanePoints uv_;
  StretchFigures of_rest_;
  std::optional<VertexBlockSystem> own_system_;
};

}  // namespace dcharts
