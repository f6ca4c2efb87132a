// SPDX-License-Identifier: GPL-3.0-or-later
/// A pattern made by hand: round pieces in pairs, each pair sewn together along its rim in three seams, like
/// a flat cushion.
#pragma once

#include <cmath>
#include <vector>

#include "common/pi.h"
#include "pattern/pattern.h"

namespace dcharts {

inline Point2 OnCircle(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// A disk with 3 * `edges_of_seam` outline points; its edges are in seams first_seam, + 1 and + 2.
inline Piece Disk(int id, int first_seam, int side, double radius, double allowance, int edges_of_seam) {
  Piece piece;
  piece.id = id;
  piece.name = "Piece " + std::to_string(id + 1);
  const int n = 3 * edges_of_seam;
  OutlineLoop loop;
  Polyline cut;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * kPi * i / n;
    OutlinePoint point;
    point.at = OnCircle(radius, angle);
    point.seam = first_seam + (side == 0 ? i / edges_of_seam : 2 - i / edges_of_seam);
    point.side = side;
    loop.push_back(point);
    cut.push_back(OnCircle(radius + allowance, angle));
    piece.net.vertices.push_back(point.at);
    if (i >= 2) piece.net.triangles.push_back({0, i - 1, i});
  }
  piece.loops = {loop};
  piece.cut = {cut};
  piece.label_radius = radius * std::cos(kPi / n);
  piece.group = id - side;
  piece.mirrored = side == 1;
  return piece;
}

// One pair of disks for each radius, side by side on a sheet.
inline Pattern Cushions(const std::vector<double>& radii, double allowance, int edges_of_seam = 16) {
  constexpr double kGap = 25;
  Pattern pattern;
  pattern.allowance = allowance;
  double x = kGap, highest = 0;
  for (double radius : radii) {
    const int id = static_cast<int>(pattern.pieces.size()),
              first_seam = static_cast<int>(pattern.seams.size());
    for (int side : {0, 1}) {
      Piece piece = Disk(id + side, first_seam, side, radius, allowance, edges_of_seam);
      const double reach = radius + allowance + kGap;
      piece.on_sheet.offset = {x + radius + allowance, kGap + radius + allowance};
      x += 2 * (radius + allowance) + kGap;
      highest = std::max(highest, 2 * reach);
      pattern.pieces.push_back(piece);
    }
    const double edge = 2 * radius * std::sin(kPi / (3 * edges_of_seam));
    for (int k = 0; k < 3; ++k) {
      Seam seam;
      seam.id = first_seam + k;
      seam.length = edge * edges_of_seam;
      seam.sides = {{id, 0, k * edges_of_seam, edges_of_seam, false, seam.length},
                    {id + 1, 0, (2 - k) * edges_of_seam, edges_of_seam, true, seam.length}};
      seam.order = seam.id + 1;
      seam.opening = k == 2;
      MatchPoint middle;
      middle.number = seam.id + 1;
      middle.arc = seam.length / 2;
      middle.kind = k == 0 ? NotchKind::kDouble : NotchKind::kSingle;
      for (const SeamSide& side : seam.sides) {
        const Point2 at =
            pattern.pieces[side.piece].loops[0][(side.first + edges_of_seam / 2) % (3 * edges_of_seam)].at;
        middle.at.push_back(at);
        middle.outward.push_back(at.normalized());
      }
      seam.match_points = {middle};
      pattern.seams.push_back(seam);
      pattern.total_seam_length += seam.length;
    }
  }
  pattern.sheet_size = {x, highest};
  return pattern;
}

}  // namespace dcharts
