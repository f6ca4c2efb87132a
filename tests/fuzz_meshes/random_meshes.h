// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/surface_data.h"
#include "random.h"

namespace dcharts::fuzz {

/// Vertices and faces of a random shape of 0 to about `faces` faces, 1 to 10 units large: sheets, tubes,
/// tori, Moebius strips and Klein bottles, globes, charts of all kinds, surfaces of voxels (handles, shells
/// inside shells, edges with four faces), fans, soups, faces at random on few vertices, hardly anything.
/// `name` gets its kind.
SurfaceData RandomShape(Random& random, int faces, std::string& name);

}  // namespace dcharts::fuzz
