// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/point_grid.h"

#include <algorithm>
#include <cmath>

#include "pattern/segments.h"

namespace dcharts {

PointGrid::PointGrid(const Points2& points) : points_(&points) {
  if (points.rows() == 0) {
    cells_.resize(1);
    return;
  }
  low_ = points.colwise().minCoeff();
  const Point2 size = points.colwise().maxCoeff().transpose() - low_;
  // About as many cells along the box as there are points on an outline.
  const double per_side = std::clamp(std::sqrt(static_cast<double>(points.rows())), 1.0, 256.0);
  cell_ = std::max(size.maxCoeff() / per_side, 1e-12);
  columns_ = static_cast<int>(size.x() / cell_) + 1;
  rows_ = static_cast<int>(size.y() / cell_) + 1;
  cells_.resize(static_cast<size_t>(columns_) * rows_);
}

int PointGrid::Column(double x) const {
  return std::clamp(static_cast<int>((x - low_.x()) / cell_), 0, columns_ - 1);
}
int PointGrid::Row(double y) const {
  return std::clamp(static_cast<int>((y - low_.y()) / cell_), 0, rows_ - 1);
}

std::vector<int>& PointGrid::CellOf(int point) {
  return cells_[static_cast<size_t>(Row((*points_)(point, 1))) * columns_ + Column((*points_)(point, 0))];
}

void PointGrid::Add(int point) { CellOf(point).push_back(point); }

void PointGrid::Remove(int point) {
  std::vector<int>& cell = CellOf(point);
  cell.erase(std::find(cell.begin(), cell.end(), point));
}

bool PointGrid::AnyInTriangle(const Point2* t, const int* but) const {
  const auto [x0, x1] = std::minmax({t[0].x(), t[1].x(), t[2].x()});
  const auto [y0, y1] = std::minmax({t[0].y(), t[1].y(), t[2].y()});
  for (int row = Row(y0); row <= Row(y1); ++row)
    for (int column = Column(x0); column <= Column(x1); ++column)
      for (int v : cells_[static_cast<size_t>(row) * columns_ + column]) {
        if (v == but[0] || v == but[1] || v == but[2]) continue;
        const Point2 p = points_->row(v).transpose();
        if (Orient(t[0], t[1], p) >= 0 && Orient(t[1], t[2], p) >= 0 && Orient(t[2], t[0], p) >= 0)
          return true;
      }
  return false;
}

}  // namespace dcharts
