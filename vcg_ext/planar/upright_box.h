// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planar/chart_mesh.h"

namespace dcharts {

/// The turn (radians) after which the points' axis-aligned box is smallest and its longer side upright.
double UprightAngle(const Points2& points);

}  // namespace dcharts
