// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"
#include "planar/vertex_block_system.h"

namespace dcharts {

/// Angle-based flattening in the reduced form of ABF++ (Sheffer, Levy, Mogilnitsky, Bogomyakov 2005): the
/// corner angles of a flat triangulation that are nearest to the surface's. They add
/// up to pi in a triangle and to 2 pi around an interior vertex, and the edge lengths they imply agree around
/// it (the products of sines). Of a chart with several loops, the angles close around the holes only when
/// these are filled.
class AngleFlattening {
 public:
  /// What counts is the squared change of an angle over the angle to the power of `relative`: 2 as in the
  /// paper, 1 for a smaller sum of plain squares. No angle gets below `smallest_angle` (radians) or above pi
  /// minus twice that. `chart` must outlive this.
  /// `fill_holes`: every loop but the longest gets a fan of triangles around one more vertex, whose angles
  /// count next to nothing. That is what a ring needs, but there is no such fan in some holes.
  AngleFlattening(const ChartMesh& chart, const RestShapes& shapes, double smallest_angle, int relative = 2,
                  bool fill_holes = false);

  /// The chart's triangles, then those that fill its holes.
  const Triangles& AllTriangles() const { return triangles_; }
  int VertexCount() const { return static_cast<int>(on_boundary_.size()); }

  /// One Newton step on the angles. The Hessian of the Lagrangian is diagonal, the triangles' conditions are
  /// eliminated, and a positive definite system with two unknowns per interior vertex remains. False when it
  /// can't be solved; then the angles are as before. `system` is one of AllTriangles().
  bool Step(VertexBlockSystem& system);

  /// Root mean square of the last step's changes, relative to the angles: about zero when they are found.
  double LastStep() const { return last_step_; }

  /// The least-squares conformal map (LSCM: Levy et al. 2002) of triangles with these angles. May flip
  /// triangles; empty when it can't be solved. `system` is one of the chart's own triangles.
  std::optional<PlanePoints> LayOut(VertexBlockSystem& system) const;

 private:
  using Corners = std::array<double, 3>;

  static Complex Row(const Corners& cotangent, int k, int corner);
  double Variance(Eigen::Index triangle, int corner) const;
  Corners Compliance(Eigen::Index triangle, const Corners& sine) const;

  void FillHoles(const std::vector<std::vector<int>>& loops);

  const ChartMesh& chart_;
  Triangles triangles_;
  double smallest_angle_;
  int relative_;
  double last_step_ = 0;
  std::vector<char> on_boundary_;  // per vertex
  std::vector<Corners> wanted_;    // the surface's angles, scaled to close around interior vertices
  std::vector<Corners> angles_;
  PlanePoints multiplier_;  // per vertex, of the sum and of the length condition
};

/// A conformal map by ABF++, without flipped triangles, its size arbitrary; of a chart with holes the better
/// of those with open and with filled holes. Empty when there is none; `why` then says so, in words that go
/// on after "chart 3: ". `poll` is called once per step and may throw.
std::optional<PlanePoints> ConformalMap(const ChartMesh& chart, const RestShapes& shapes,
                                        VertexBlockSystem& system, const std::function<void()>& poll,
                                        std::string& why);

}  // namespace dcharts
