// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/texts.h"

#include <cmath>
#include <locale>
#include <sstream>

namespace dcharts {

std::string LengthText(double millimetres) {
  constexpr double kLargest = 1e15;  // digits beyond would mean nothing, and soon not fit
  if (!(std::abs(millimetres) < kLargest)) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << millimetres << " mm";
    return text.str();
  }
  const long long tenths = std::llround(millimetres * 10);
  std::string text = std::to_string(tenths / 10);
  if (tenths % 10 != 0) text += "." + std::to_string(std::abs(tenths % 10));
  return text + " mm";
}

std::string PieceList(const std::vector<int>& pieces) {
  std::string text = pieces.size() == 1 ? "piece " : "pieces ";
  for (size_t k = 0; k < pieces.size(); ++k) {
    if (k > 0) text += k + 1 == pieces.size() ? " and " : ", ";
    text += std::to_string(pieces[k] + 1);
  }
  return text;
}

}  // namespace dcharts
