// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dcharts {

/// The figures of a run. A figure that a stage does not know stays empty and is not reported.
/// Stretch is that of Sander et al. 2001 with the UV area scaled to the surface area (1 = isometric).
struct Report {
  std::optional<int> charts;
  std::optional<int> unassigned_faces;
  std::optional<int> iterations;       ///< Lloyd iterations
  std::optional<double> l2_stretch;    ///< >= 1
  std::optional<double> linf_stretch;  ///< infinite with a UV-degenerate or flipped face
  std::optional<double> l2_shear;      ///< area-weighted mean of (G-g)^2 / (G^2+g^2), 0..1
  std::optional<double> seam_length;  ///< 3D, interior edges between charts and cuts, each once, / sqrt(area)
  std::optional<int> darts;
  std::optional<int> flipped_faces;
  std::optional<int> degenerate_faces;  ///< with surface area, but (nearly) none in the texcoords
  std::optional<int> overlapping_faces;
  std::optional<double> packing_efficiency;  ///< UV area / area of the UVs' bounding square, 0..1
  std::optional<double> seconds;             ///< wall clock, whole filter
  std::vector<std::pair<std::string, double>> stage_seconds;  ///< (stage name, wall clock), in order
};

}  // namespace dcharts
