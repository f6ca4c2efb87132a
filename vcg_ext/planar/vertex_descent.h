// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"
#include "planar/stretch_energy.h"

namespace dcharts {

/// A triangle at a vertex that may move: its rest shape, seen from that vertex as its first corner, and the
/// places of the other two, counterclockwise.
struct FanTriangle {
  RestShape shape;
  Complex z1, z2;
};

/// The shape seen from corner `k` as its first one.
RestShape SeenFromCorner(const RestShape& shape, int k);

/// What the triangles around a vertex at `z` cost, weights included; infinite when one is not positive.
double FanEnergy(const StretchEnergy& energy, const std::vector<FanTriangle>& fan, const Complex& z);

/// A projected Newton step of one vertex. `value`: FanEnergy at `z`, finite; is lowered with it.
void ImproveVertex(const StretchEnergy& energy, const std::vector<FanTriangle>& fan, Complex& z,
                   double& value);

/// Lowers the energy of a map vertex by vertex (nonlinear Gauss-Seidel) without flipping a triangle. Takes
/// linear time and memory, but evens out only what is uneven over a few triangles: for maps continued from a
/// coarser chart.
class VertexSweeps {
 public:
  /// Both must outlive this object; `shapes` may change in between.
  VertexSweeps(int vertex_count, const Triangles& triangles, const RestShapes& shapes);

  /// Sweeps over all vertices, until little is gained. All areas must be positive.
  void EvenOut(const std::function<void()>& poll, PlanePoints& uv) const;

  /// Lowers the worst stretch by what the triangles around the worst ones can do; the mean stretch may rise
  /// by next to nothing.
  void LowerWorst(const std::function<void()>& poll, PlanePoints& uv) const;

 private:
  /// One step of a vertex; returns how much energy it gained.
  double Step(const StretchEnergy& energy, int vertex, std::vector<FanTriangle>& fan, PlanePoints& uv) const;
  /// Per triangle TriangleContraction, 0 for slivers.
  std::vector<double> Contractions(const std::function<void()>& poll, const PlanePoints& uv) const;

  /// All vertices: two halves that share no triangle, and those between them.
  std::vector<std::vector<int>> Halves() const;

  /// Vertices in groups that hang together over triangles; in each they keep their order. A step of a vertex
  /// in one group does nothing to another.
  std::vector<std::vector<int>> Clusters(const std::vector<int>& vertices) const;

  /// The vertices of triangles contracted by more than `bound`, and their neighbours.
  std::vector<int> VerticesNear(const std::vector<double>& contractions, double bound) const;

  const Triangles& triangles_;
  const RestShapes& shapes_;
  std::vector<int> first_, corners_;  // the corners at vertex v: corners_[first_[v]] up to first_[v + 1]
};

}  // namespace dcharts
