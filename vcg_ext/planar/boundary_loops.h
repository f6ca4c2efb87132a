// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "planar/chart_mesh.h"

namespace dcharts {

/// The boundary loops of a chart, each as its vertices in the direction of the triangles' own edges (outer
/// loops run counterclockwise in an unflipped map). A loop starts at its smallest vertex, loops come in the
/// order of their smallest vertex. The chart must be sound, see WhyNotAChart.
std::vector<std::vector<int>> BoundaryLoops(const Triangles& triangles);

/// Why these arrays aren't a chart (connected, manifold, oriented, genus 0, with a boundary), as a sentence;
/// empty when they are one.
std::string WhyNotAChart(const ChartMesh& chart);

}  // namespace dcharts
