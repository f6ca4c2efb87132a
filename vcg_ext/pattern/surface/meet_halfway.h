// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "common/surface_data.h"
#include "pattern/surface/symmetric_mesh.h"

namespace dcharts {

/// `symmetric` is half of `users` and its image in a plane with that normal. Where the other half is further
/// than `distance` from that image, both give way, so that neither is left with the whole difference.
void MeetHalfway(const SurfaceData& users, double distance, const Eigen::Vector3d& plane_normal,
                 SymmetricMesh& symmetric);

}  // namespace dcharts
