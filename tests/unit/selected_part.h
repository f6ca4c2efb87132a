// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "common/surface_data.h"

namespace dcharts::test {

/// Of values per face, those of the selected faces.
template <class T>
std::vector<T> OfSelected(const std::vector<T>& values, const SurfaceData& mesh) {
  std::vector<T> some;
  for (std::size_t f = 0; f < std::min(values.size(), mesh.selected.size()); ++f)
    if (mesh.selected[f] != 0) some.push_back(values[f]);
  return some;
}

/// The shape of the selected faces alone.
inline SurfaceData SelectedPart(const SurfaceData& mesh) {
  SurfaceData part;
  part.vertices = mesh.vertices;
  part.faces = OfSelected(mesh.faces, mesh);
  return part;
}

}  // namespace dcharts::test
