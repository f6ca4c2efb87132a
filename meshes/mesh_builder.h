// SPDX-License-Identifier: GPL-3.0-or-later
/// Small tools to put a triangle mesh together.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/surface_data.h"

namespace dcharts::shapes {

/// Throws std::invalid_argument when a count is below its minimum.
void RequireAtLeast(const char* what, int value, int minimum);

enum class Facing { kUp, kDown };

/// Collects vertices and faces.
class MeshBuilder {
 public:
  int AddVertex(const Eigen::Vector3d& p);
  void AddFace(int a, int b, int c);
  /// Corners counter-clockwise; split along the shorter diagonal, the first one when they are about equal.
  void AddQuad(int a, int b, int c, int d);
  /// Quads between two closed rings of the same length; `lower` runs counter-clockwise seen from `upper`'s
  /// outside.
  void AddBand(const std::vector<int>& lower, const std::vector<int>& upper);
  /// Triangles from a closed ring to one point, oriented like AddBand.
  void AddFan(const std::vector<int>& ring, int apex);
  /// Regular polygon of n corners at height z, counter-clockwise seen from +z; returns its vertices.
  std::vector<int> AddRing(const Eigen::Vector2d& centre, double radius, int n, double z);
  /// Fills the flat region within closed rings of vertices (the first outside, the others holes) that share
  /// one height z, with triangles of about `edge_length`. Throws as FillPolygon does.
  void AddFlat(const std::vector<std::vector<int>>& rings, double edge_length, Facing facing);

  Eigen::Vector3d Position(int vertex) const;
  SurfaceData Take();

 private:
  SurfaceData mesh_;
};

/// All faces the other way round.
void FlipFaces(SurfaceData& mesh);
/// Adds a copy of `other`, moved by `offset`, without joining anything.
void Append(SurfaceData& mesh, const SurfaceData& other, const Eigen::Vector3d& offset);
/// Joins vertices closer than `distance`; faces keep their order, vertices the order of their first copy.
SurfaceData Weld(const SurfaceData& mesh, double distance);

}  // namespace dcharts::shapes
