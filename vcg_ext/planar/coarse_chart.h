// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "planar/chart_mesh.h"
#include "planar/coarsener.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"

namespace dcharts {

/// A chart with fewer triangles, whose maps can be continued to the chart itself: the collapses are taken
/// back one by one in the plane [Hormann, Greiner, Campagna, "Hierarchical Parametrization of Triangulated
/// Surfaces", 1999].
class CoarseChart {
 public:
  /// `chart` must have an area of about 1 and outlive this object.
  CoarseChart(const ChartMesh& chart, int target_faces, const std::function<void()>& poll = {});

  const ChartMesh& Mesh() const { return mesh_; }
  const std::vector<int>& SourceVertices() const { return source_; }    ///< of the chart, per vertex
  const std::vector<int>& SourceFaces() const { return source_face_; }  ///< ascending, per triangle
  const std::vector<int>& Opposite() const { return opposite_; }        ///< per half-edge, -1 at a border

  /// A map of the chart without flipped triangles; `uv` (#V of Mesh() by 2) must have none, and be about as
  /// large as the surface. Each vertex comes to where the triangles that it has then cost least. Nothing
  /// when there is no room for one, which only rounding makes so.
  std::optional<PlanePoints> Continued(const Points2& uv, const std::function<void()>& poll) const;

 private:
  // Where the ring of a step ends.
  int RingEnd(int step) const {
    const auto next = static_cast<std::size_t>(step) + 1;
    return next < history_.steps.size() ? history_.steps[next].ring_begin
                                        : static_cast<int>(history_.rings.size());
  }
  // Steps of one run, the last first; false when there is no room for a vertex.
  bool Continue(int begin, int end, const RestFloors& floors, const std::function<void()>& poll,
                PlanePoints& map) const;

  const ChartMesh& chart_;
  ChartMesh mesh_;
  std::vector<int> source_, source_face_, opposite_;
  CollapseHistory history_;
};

}  // namespace dcharts
