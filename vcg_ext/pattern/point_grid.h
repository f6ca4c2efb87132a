// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pattern/pattern.h"
#include "planar/chart_mesh.h"

namespace dcharts {

/// Points in the plane, some of them there, sorted into the cells of a grid.
class PointGrid {
 public:
  /// Knows the places of all points, #V by 2; none is there yet.
  explicit PointGrid(const Points2& points);

  void Add(int point);
  void Remove(int point);

  /// True when a point that is there, none of `but` (three points), lies in the triangle (counterclockwise,
  /// with its border).
  bool AnyInTriangle(const Point2* triangle, const int* but) const;

 private:
  int Column(double x) const;
  int Row(double y) const;
  std::vector<int>& CellOf(int point);

  const Points2* points_;
  Point2 low_{0, 0};
  double cell_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> cells_;
};

}  // namespace dcharts
