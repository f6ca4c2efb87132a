// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/number_text.h"

#include <locale>
#include <sstream>

namespace dcharts {

std::string NumberText(double value, int decimals) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.setf(std::ios::fixed);
  out.precision(decimals);
  out << value;
  std::string text = out.str();
  if (text.find('.') != std::string::npos) {
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace dcharts
