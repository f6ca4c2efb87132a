// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

namespace dcharts::fuzz {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What face qualities, texcoords and parameters may hold and should not.
inline constexpr double kOdd[] = {kNan, kInfinity, -kInfinity, -7,           -1,     -0.0,
                                  0.5,  1e30,      -1e30,      2147483648.0, 1e-320, 1.02};

}  // namespace dcharts::fuzz
