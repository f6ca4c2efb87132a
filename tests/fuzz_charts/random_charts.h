// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "planar/chart_mesh.h"

namespace dcharts::fuzz {

enum class ChartKind { kDisk, kSheet, kSpiral, kComb, kCylinder, kLoops, kFinger };
constexpr int kChartKinds = 7;
const char* NameOf(ChartKind kind);

struct RandomChart {
  ChartKind kind = ChartKind::kDisk;
  ChartMesh mesh;
};

/// A chart of 1 to about 1000 triangles, up to half of them slivers with areas down to 1e-9 of the chart's
/// squared size and below, at a scale between 1e-6 and 1e6. The same seed gives the same chart.
RandomChart MakeRandomChart(std::uint64_t seed);

}  // namespace dcharts::fuzz
