// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace dcharts {

/// "12.3 mm", the same in every language.
std::string LengthText(double millimetres);

/// "piece 3", "pieces 3, 5 and 8", for ids from 0.
std::string PieceList(const std::vector<int>& pieces);

}  // namespace dcharts
