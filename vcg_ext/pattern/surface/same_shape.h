// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/surface_data.h"
#include "pattern/surface/face_tree.h"

namespace dcharts {

/// Whether one mesh may stand for the other: each is nowhere (at its vertices) further than `distance` from
/// the other, units of the meshes, and their areas differ by no more than the share `area_share`.
bool AreSameShape(const SurfaceData& a, const SurfaceData& b, double distance, double area_share);

/// Per face of `from` the face of `to` at its place, which looks the same way.
std::vector<int> FacesAtPlacesOf(const FaceTree& from, const FaceTree& to);

}  // namespace dcharts
