// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "common/progress.h"
#include "common/report.h"
#include "planar/distortion.h"
#include "planar/overlap.h"
#include "surface/charts.h"
#include "surface/seams.h"

namespace dcharts {

/// A face with a texcoord that is infinite or not a number gets none: its corners are put in one place, which
/// is a place of another face, so that the others are measured as if it were not there.
inline WedgeTexcoords WithFiniteTexcoords(WedgeTexcoords uv) {
  const auto finite = [](const std::array<float, 6>& t) {
    return std::all_of(t.begin(), t.end(), [](float x) { return std::isfinite(x); });
  };
  const auto good = std::find_if(uv.begin(), uv.end(), finite);
  std::array<float, 6> nowhere{};
  for (std::size_t k = 0; k < 6 && good != uv.end(); ++k) nowhere[k] = (*good)[k % 2];
  for (auto& t : uv)
    if (!finite(t)) t = nowhere;
  return uv;
}

/// Distortion, flips, overlaps and packing of texcoords as they stand. Charts may be mirrored: a face is
/// flipped when its orientation is not that of the larger part of its chart's area. `ids`: charts, connected
/// over equal texcoords. Texcoords must be finite.
template <class MeshType>
void MeasureAtlas(const SurfaceGraph<MeshType>& surface, const ChartIds& ids, const WedgeTexcoords& uv,
                  Progress& progress, Report& report) {
  const int face_count = surface.FaceCount();
  Eigen::Vector3d low = surface.Position(0, 0), high = low;
  Eigen::Vector2d uv_low = Eigen::Vector2d::Constant(1e300), uv_high = -uv_low;
  for (int f = 0; f < face_count; ++f)
    for (int i = 0; i < 3; ++i) {
      low = low.cwiseMin(surface.Position(f, i));
      high = high.cwiseMax(surface.Position(f, i));
      const Eigen::Vector2d p(uv[f][2 * i], uv[f][2 * i + 1]);
      uv_low = uv_low.cwiseMin(p);
      uv_high = uv_high.cwiseMax(p);
    }
  const double area_floor = kAreaFloor * (high - low).squaredNorm();
  const double uv_side = (uv_high - uv_low).maxCoeff();

  auto signed_area = [&](int f) {
    const auto& t = uv[f];
    return 0.5 *
           ((double(t[2]) - t[0]) * (double(t[5]) - t[1]) - (double(t[3]) - t[1]) * (double(t[4]) - t[0]));
  };
  std::vector<double> chart_area(ChartCount(ids), 0);
  for (int f = 0; f < face_count; ++f) chart_area[ids[f]] += signed_area(f);

  StretchFigures figures;
  double surface_area = 0, uv_area = 0;
  for (int f = 0; f < face_count; ++f) {
    surface_area += surface.Area(f);
    uv_area += std::abs(signed_area(f));
  }
  constexpr double kDegenerate = 1e-8;  // of the UV area that a face's surface area should have
  int flipped = 0, degenerate = 0;
  std::vector<GridTriangle> grid(face_count);
  // A power of two: texcoords on a grid, as ours are, keep their places exactly, and what touches only
  // touches.
  const double cells = uv_side > 0 ? std::exp2(std::floor(std::log2((1 << 28) / uv_side))) : 0;
  for (int f = 0; f < face_count; ++f) {
    const double mirror = chart_area[ids[f]] < 0 ? -1 : 1;
    Eigen::Matrix3d corners;
    Eigen::Matrix<double, 3, 2> flat;
    for (int i = 0; i < 3; ++i) {
      corners.row(i) = surface.Position(f, i);
      flat.row(i) << mirror * uv[f][2 * i], uv[f][2 * i + 1];
      for (int d : {0, 1})
        grid[f][2 * i + d] = static_cast<std::int32_t>(std::lround((uv[f][2 * i + d] - uv_low[d]) * cells));
    }
    figures.Add(StretchOfTriangle(corners, flat), area_floor);
    if (!(surface.Area(f) > area_floor)) continue;
    if (std::abs(signed_area(f)) * surface_area <= kDegenerate * surface.Area(f) * uv_area)
      ++degenerate;
    else if (signed_area(f) * mirror < 0)
      ++flipped;
  }
  progress.Poll();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  report.l2_stretch = degenerate > 0 ? kInfinite : figures.L2();
  report.linf_stretch = degenerate > 0 ? kInfinite : figures.Linf();
  report.l2_shear = figures.Shear();
  report.flipped_faces = flipped;
  report.degenerate_faces = degenerate;
  report.packing_efficiency = uv_side > 0 ? uv_area / (uv_side * uv_side) : 0;

  std::vector<char> overlaps(face_count, 0);
  constexpr size_t kEnough = 20'000'000;
  for (const auto& [i, j] : OverlappingPairs(grid, kEnough, [&] { progress.Poll(); }))
    overlaps[i] = overlaps[j] = 1;
  report.overlapping_faces = static_cast<int>(std::count(overlaps.begin(), overlaps.end(), 1));
}

}  // namespace dcharts
