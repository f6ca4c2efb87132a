// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dcharts {

/// What a seam as long as the side of a square with the surface's area may cost at params.seam_weight 1, in
/// the symmetric Dirichlet energy (over 4, less 1) of all charts, for a surface of area 1.
constexpr double kSeamPrice = 0.00225;

}  // namespace dcharts
