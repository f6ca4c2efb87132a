// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dcharts {

constexpr double kPi = 3.14159265358979323846;

}  // namespace dcharts
