// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/pattern.h"

#include <cmath>

namespace dcharts {

Point2 PiecePlacement::operator()(const Point2& p) const {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x() - s * p.y() + offset.x(), s * p.x() + c * p.y() + offset.y()};
}

}  // namespace dcharts
