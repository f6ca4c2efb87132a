// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/surface_data.h"
#include "pattern/surface/face_tree.h"

namespace dcharts {

/// How much two meshes of one shape may differ.
struct ShapeLimits {
  double distance = 0;  ///< of vertices to the other mesh, units of the meshes
  double area = 0;      ///< share of the area
  double rare = 0;      ///< share of the vertices that may be further away than `distance`...
  double farthest = 0;  ///< ...but not than this
};

/// Whether one mesh may stand for the other.
bool AreSameShape(const SurfaceData& a, const SurfaceData& b, const ShapeLimits& limits);

/// Per face of `from` the face of `to` at its place, which looks the same way.
std::vector<int> FacesAtPlacesOf(const FaceTree& from, const FaceTree& to);

}  // namespace dcharts
