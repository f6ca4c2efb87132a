// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/surface_data.h"
#include "pattern/drawing/drawing.h"

namespace dcharts {

/// A picture of the model with its pieces in colours and their borders as dark lines, and where each piece
/// is seen in it.
struct ModelView {
  /// Where a piece has most room in the picture.
  struct Spot {
    Point2 at{0, 0};    ///< pixels from the picture's upper left corner
    double radius = 0;  ///< pixels to the nearest that does not show the piece; 0: the piece is not seen
  };

  Picture picture;          ///< square; its place on the sheet is not set
  std::vector<Spot> spots;  ///< per piece
  std::vector<bool> empty;  ///< per pixel: nothing is there
};

/// The axis, 1 (y) or 2 (z), that most likely points up: the one at whose lower end the model has something
/// broad to stand on. Only a guess; y where both are alike.
int GuessUp(const SurfaceData& mesh);

/// Draws the model from a direction, without perspective, the axis `up` (1 or 2) upwards. Angles in degrees:
/// `azimuth` around that axis, `elevation` above the ground. `pixels`: side of the picture.
ModelView ViewModel(const SurfaceData& mesh, const std::vector<int>& piece_of_face, int piece_count, int up,
                    double azimuth, double elevation, int pixels);

}  // namespace dcharts
