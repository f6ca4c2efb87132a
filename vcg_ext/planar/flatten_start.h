// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"
#include "planar/vertex_block_system.h"

namespace dcharts {

/// Puts a map without flipped triangles in `uv`, at its best size: `known` (#V by 2 in any scale, may be
/// null) when that is good, else the one from angles when that is good, else the better of it and Tutte's.
/// Returns its symmetric Dirichlet energy (see StretchEnergy), infinite when none is free of flips. `chart`
/// must be normalized.
double FlattenStart(const ChartMesh& chart, const RestShapes& shapes, const Points2* known,
                    VertexBlockSystem& system, const std::function<void()>& poll, PlanePoints& uv);

/// Whether `known` (may be null) has a place for every vertex of the chart.
bool IsUsableStart(const ChartMesh& chart, const Points2* known);

/// A known map with a symmetric Dirichlet energy above it isn't used as a start.
constexpr double kGoodKnown = 3;

/// Brings a map to the size at which its symmetric Dirichlet energy is least; returns that energy, infinite
/// when the map flips.
double ScaleToBest(const Triangles& triangles, const RestShapes& shapes, PlanePoints& uv);

}  // namespace dcharts
