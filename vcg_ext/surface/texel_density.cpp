// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/texel_density.h"

#include <cmath>
#include <string>

namespace dcharts {

std::vector<double> DensityByVertexQuality(const SurfaceData& data, const std::vector<int>& source_face,
                                           Progress& progress) {
  double largest = 0;
  int ignored = 0;
  for (double q : data.vertex_quality) {
    if (std::isfinite(q) && q >= 0)
      largest = std::max(largest, q);
    else
      ++ignored;
  }
  if (ignored > 0)
    progress.Log(std::to_string(ignored) +
                 " vertices have a quality that is negative, infinite or not a number: it counts as 0.");
  std::vector<double> density;
  bool any = false;
  if (largest > 0)
    for (int f : source_face) {
      double sum = 0;
      for (int v : data.faces[f]) {
        const double q = data.vertex_quality[v];
        if (std::isfinite(q) && q > 0) sum += q / largest / 3;
      }
      any = any || sum > 0;
      density.push_back(sum);
    }
  if (any) return density;
  progress.Log("No vertex has a quality above 0: all charts get the same texels per length.");
  return {};
}

}  // namespace dcharts
