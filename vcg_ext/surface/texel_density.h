// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "common/progress.h"
#include "common/surface_data.h"
#include "surface/charts.h"
#include "surface/surface_graph.h"

namespace dcharts {

/// A chart has at least this share of the largest density.
constexpr double kLeastDensity = 0.01;

/// Per face of the surface (`source_face`: its index in `data`) the mean quality of its vertices; values that
/// are negative or not finite count as 0, and the log says so. Empty, and logged, when no face has a positive
/// one.
std::vector<double> DensityByVertexQuality(const SurfaceData& data, const std::vector<int>& source_face,
                                           Progress& progress);

/// Per chart the texels per length that it gets, 1 for the densest: the mean over its area of its faces'
/// densities, at least kLeastDensity. `of_face` empty: 1 for all.
template <class MeshType>
std::vector<double> ChartDensities(const SurfaceGraph<MeshType>& surface, const ChartIds& ids,
                                   const std::vector<double>& of_face) {
  std::vector<double> density(static_cast<size_t>(ChartCount(ids)), 0), area = density;
  if (of_face.empty()) {
    std::fill(density.begin(), density.end(), 1);
    return density;
  }
  for (int f = 0; f < surface.FaceCount(); ++f) {
    density[ids[f]] += surface.Area(f) * of_face[f];
    area[ids[f]] += surface.Area(f);
  }
  for (size_t c = 0; c < density.size(); ++c) density[c] = area[c] > 0 ? density[c] / area[c] : 0;
  const double largest = *std::max_element(density.begin(), density.end());
  for (double& d : density) d = largest > 0 ? std::max(kLeastDensity, d / largest) : 1;
  return density;
}

}  // namespace dcharts
