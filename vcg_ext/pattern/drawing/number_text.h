// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace dcharts {

/// A number with at most this many decimals, in the C locale, without needless zeros: "12.5", "0", "-3".
std::string NumberText(double value, int decimals);

}  // namespace dcharts
