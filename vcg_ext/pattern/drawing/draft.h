// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/surface_data.h"
#include "pattern/pattern.h"

namespace dcharts {

/// What a drawing is made of, and what could not be drawn.
struct Draft {
  const Pattern& pattern;
  const SurfaceData& mesh;  ///< of which the pattern was made
  std::string title;
  bool print_texture = false;           ///< the model's colours are drawn into the pieces
  std::vector<std::string> unplaced{};  ///< labels that found no room: "Piece 3: grain arrow"
};

}  // namespace dcharts
