// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes as scanners deliver them.
#pragma once

#include <cmath>
#include <random>

#include "common/surface_data.h"

namespace dcharts::test {

inline double MeanEdge(const SurfaceData& mesh) {
  double sum = 0;
  for (const auto& face : mesh.faces)
    for (size_t i = 0; i < 3; ++i) {
      const auto &a = mesh.vertices[face[i]], &b = mesh.vertices[face[(i + 1) % 3]];
      sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
  return sum / (3 * static_cast<double>(mesh.faces.size()));
}

/// Each coordinate off by `share` of the mean edge (standard deviation).
inline SurfaceData Noisy(SurfaceData mesh, double share, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, share * MeanEdge(mesh));
  for (auto& p : mesh.vertices)
    for (double& x : p) x += noise(random);
  return mesh;
}

}  // namespace dcharts::test
