// SPDX-License-Identifier: GPL-3.0-or-later
/// Files of charts, for the programs here and in Python: one chart after the other, each as two int32 (number
/// of vertices, of triangles), 3 doubles per vertex and 3 int32 per triangle, in the machine's byte order.
#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "planar/chart_mesh.h"

namespace dcharts::bench {

template <class Value>
void WriteValues(std::ofstream& file, const Value* values, Eigen::Index count) {
  file.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(sizeof(Value)) * count);
}

/// Throws std::runtime_error when the file can't be read or ends inside a chart.
inline std::vector<ChartMesh> ReadCharts(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("Can't read " + path);
  const auto read = [&](auto* values, Eigen::Index count) {
    const auto bytes = static_cast<std::streamsize>(sizeof(*values)) * count;
    file.read(reinterpret_cast<char*>(values), bytes);
    return file.gcount() == bytes;
  };
  std::vector<ChartMesh> charts;
  for (std::int32_t size[2]; read(size, 2);) {
    ChartMesh chart;
    chart.positions.resize(size[0], 3);
    chart.triangles.resize(size[1], 3);
    if (!read(chart.positions.data(), chart.positions.size()) ||
        !read(chart.triangles.data(), chart.triangles.size())) {
      throw std::runtime_error(path + " ends too early.");
    }
    charts.push_back(std::move(chart));
  }
  return charts;
}

inline void WriteChart(std::ofstream& file, const ChartMesh& chart) {
  const std::int32_t size[2] = {static_cast<std::int32_t>(chart.positions.rows()),
                                static_cast<std::int32_t>(chart.triangles.rows())};
  WriteValues(file, size, 2);
  WriteValues(file, chart.positions.data(), chart.positions.size());
  WriteValues(file, chart.triangles.data(), chart.triangles.size());
}

}  // namespace dcharts::bench
