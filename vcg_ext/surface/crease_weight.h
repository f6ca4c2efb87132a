// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/pi.h"
#include "surface/charts.h"
#include "surface/surface_graph.h"

namespace dcharts {

/// Dihedral angle at a half-edge, radians: 0 where flat, at borders and at faces without area.
template <class MeshType>
double DihedralAngle(const SurfaceGraph<MeshType>& surface, int half_edge) {
  const int g = surface.Neighbour(half_edge);
  if (g < 0) return 0;
  const auto &m = surface.Normal(half_edge / 3), &n = surface.Normal(g);
  if (m.isZero(0) || n.isZero(0)) return 0;
  return std::acos(std::clamp(m.dot(n), -1.0, 1.0));
}

/// Edges that bend more sharply than an angle in degrees, as a seam mask on both sides.
template <class MeshType>
SeamMask CreasesAbove(const SurfaceGraph<MeshType>& surface, double degrees) {
  constexpr double kRounding = 0.01;  // degrees; of coordinates in float
  SeamMask creases(surface.FaceCount(), 0);
  if (degrees >= 180) return creases;
  for (int h = 0; h < surface.HalfEdgeCount(); ++h)
    if (DihedralAngle(surface, h) * 180 / kPi > degrees + kRounding) SetSeam(creases, h);
  return creases;
}

/// What a unit of border length counts at each half-edge, so that borders run along creases: 1 where the
/// surface is smooth, down to 0.25 on a crease. A crease bends more than its surroundings: on a coarse mesh
/// every edge of a round shape bends, and none is a crease.
template <class MeshType>
std::vector<double> CreaseWeights(const SurfaceGraph<MeshType>& surface) {
  constexpr double kDegree = kPi / 180;
  // Vertex noise of 5 % of the edge length bends edges by about 7 degrees, seldom by 25.
  constexpr double kSmooth = 25 * kDegree, kSharp = 45 * kDegree;
  // Cheap enough to draw borders to creases; cheaper still, they zigzag where a crease fades out.
  constexpr double kLeast = 0.25;
  std::vector<double> angle(surface.HalfEdgeCount()), weight(surface.HalfEdgeCount(), 1);
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) angle[h] = DihedralAngle(surface, h);
  // Of a face that has two creases, one of the other two edges is still flat.
  auto around = [&](int h) { return std::min(angle[Next(h)], angle[Previous(h)]); };
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int o = surface.Opposite(h);
    if (o < 0) continue;
    const double bend = angle[h] - std::max(around(h), around(o));
    const double t = std::clamp((bend - kSmooth) / (kSharp - kSmooth), 0.0, 1.0);
    weight[h] = 1 - (1 - kLeast) * t * t * (3 - 2 * t);
  }
  return weight;
}

}  // namespace dcharts
