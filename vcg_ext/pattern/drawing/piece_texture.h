// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/surface_data.h"
#include "pattern/drawing/drawing.h"
#include "pattern/drawing/placed_piece.h"

namespace dcharts {

/// The model's colours on a piece: its texture where it has one, else the colours of its faces' corners.
/// Clipped at the net outline. The picture is empty (0 by 0) when the model has no colours.
Picture PieceTexture(const SurfaceData& mesh, const PlacedPiece& placed);

}  // namespace dcharts
