// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <unordered_map>
#include <vector>

#include <Eigen/Geometry>

#include "pattern/drawing/drawing.h"
#include "pattern/drawing/text_box.h"

namespace dcharts {

/// What is on a sheet already, to find room for more: lines and boxes. Touching counts as overlapping.
class LabelSpace {
 public:
  /// Labels are to stay within this rectangle.
  LabelSpace(const Point2& low, const Point2& high) : low_(low), high_(high) {}

  /// `owner`: 0 or more, what a leader of the same owner may cross; -1: no leader may.
  void AddLine(const Polyline& points, bool closed, int owner);
  void AddBox(const Box& box);

  /// Nothing crosses or lies in the box, and it is within the rectangle.
  bool IsFree(const Box& box) const;

  /// The segment crosses no box, and no line but those of `owner` (-1: no line at all).
  bool IsFree(const Point2& from, const Point2& to, int owner) const;

 private:
  struct Item {
    std::vector<Point2> corners;  ///< 2 of a segment, 4 of a box
    Eigen::AlignedBox2d extent;   ///< of the corners
    int owner;
  };

  void Add(std::vector<Point2> corners, int owner);
  template <class Visit>
  bool AnyNear(const Eigen::AlignedBox2d& extent, Visit visit) const;
  template <class Wanted>
  bool AnyMeets(const std::vector<Point2>& corners, Wanted wanted) const;

  Point2 low_, high_;
  std::vector<Item> items_;
  std::unordered_map<long long, std::vector<int>>
      cells_;  ///< items by the square of the sheet they may be in
};

/// Two convex polygons of 2 corners (a segment) or more have a point in common.
bool Overlap(const std::vector<Point2>& a, const std::vector<Point2>& b);

/// The parts of a segment that are outside all of the boxes.
std::vector<Polyline> OutsideBoxes(const Point2& from, const Point2& to, const std::vector<Box>& boxes);

}  // namespace dcharts
