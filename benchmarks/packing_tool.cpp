// SPDX-License-Identifier: GPL-3.0-or-later
// The packing alone, for measuring.
//   packing_tool charts MESH OUT CHART_COUNT TARGET_CHARTS
//       makes an atlas of the one mesh in MESH and writes its flat charts
//   packing_tool pack CHARTS OUT TEXTURE_SIZE PADDING
//       packs flat charts into the unit square; OUT holds them placed; prints cpu seconds and the padding
//       kept
// Files of charts are those of chart_file.h; flat charts have z = 0.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "chart_file.h"
#include "dcharts.h"
#include "planar/packing.h"

namespace {

using dcharts::ChartMesh;
using dcharts::Points2;

void WriteFlatCharts(const std::string& in, const std::string& out, int chart_count, int target_charts) {
  const ChartMesh mesh = dcharts::bench::ReadCharts(in).at(0);
  dcharts::SurfaceData data;
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
    data.vertices.push_back({mesh.positions(v, 0), mesh.positions(v, 1), mesh.positions(v, 2)});
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    data.faces.push_back({mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)});
  dcharts::Params params;
  params.chart_count = chart_count;
  params.target_charts = target_charts;
  dcharts::Progress progress;
  const dcharts::SurfaceChange atlas = dcharts::TextureAtlas(data, params, progress);

  std::vector<std::vector<int>> faces(static_cast<size_t>(atlas.report.charts.value()));
  for (size_t f = 0; f < atlas.chart_ids.size(); ++f)
    faces[static_cast<size_t>(atlas.chart_ids[f])].push_back(static_cast<int>(f));
  std::ofstream file(out, std::ios::binary);
  for (const std::vector<int>& of_chart : faces) {
    std::map<std::pair<float, float>, int> vertices;  // equal texcoords are one vertex
    ChartMesh chart;
    chart.triangles.resize(static_cast<Eigen::Index>(of_chart.size()), 3);
    for (size_t k = 0; k < of_chart.size(); ++k)
      for (int i = 0; i < 3; ++i) {
        const auto& uv = atlas.wedge_texcoords[static_cast<size_t>(of_chart[k])];
        chart.triangles(static_cast<Eigen::Index>(k), i) =
            vertices.try_emplace({uv[2 * i], uv[2 * i + 1]}, static_cast<int>(vertices.size())).first->second;
      }
    chart.positions.resize(static_cast<Eigen::Index>(vertices.size()), 3);
    for (const auto& [uv, v] : vertices) chart.positions.row(v) << uv.first, uv.second, 0;
    dcharts::bench::WriteChart(file, chart);
  }
  std::printf("%zu charts\n", faces.size());
}

Points2 OutlineOf(const ChartMesh& chart) {
  std::set<std::pair<int, int>> border;
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = chart.triangles(t, i), b = chart.triangles(t, (i + 1) % 3);
      if (border.erase({b, a}) == 0) border.insert({a, b});
    }
  Points2 outline(static_cast<Eigen::Index>(2 * border.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [a, b] : border) {
    outline.row(row++) = chart.positions.row(a).head<2>();
    outline.row(row++) = chart.positions.row(b).head<2>();
  }
  return outline;
}

void PackCharts(const std::string& in, const std::string& out, const dcharts::PackOptions& options) {
  std::vector<ChartMesh> charts = dcharts::bench::ReadCharts(in);
  std::vector<Points2> outlines;
  for (const ChartMesh& chart : charts) outlines.push_back(OutlineOf(chart));
  const std::clock_t start = std::clock();
  const dcharts::Packing packing = dcharts::Pack(outlines, options);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::ofstream file(out, std::ios::binary);
  for (size_t k = 0; k < charts.size(); ++k) {
    const dcharts::Placement& place = packing.placements[k];
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(place.angle).toRotationMatrix();
    for (Eigen::Index v = 0; v < charts[k].positions.rows(); ++v) {
      const Eigen::Vector2d p = charts[k].positions.row(v).head<2>();
      charts[k].positions.row(v).head<2>() = packing.scale * (turn * p) + place.offset;
    }
    dcharts::bench::WriteChart(file, charts[k]);
  }
  std::printf("%.6f %.3f\n", seconds, packing.padding);
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  try {
    if (words.size() == 5 && words[0] == "charts") {
      WriteFlatCharts(words[1], words[2], std::atoi(words[3].c_str()), std::atoi(words[4].c_str()));
    } else if (words.size() == 5 && words[0] == "pack") {
      dcharts::PackOptions options;
      options.texture_size = std::atoi(words[3].c_str());
      options.padding = std::atoi(words[4].c_str());
      PackCharts(words[1], words[2], options);
    } else {
      std::fputs(
          "usage: packing_tool charts MESH OUT CHART_COUNT TARGET_CHARTS | pack CHARTS OUT TEXTURE_SIZE "
          "PADDING\n",
          stderr);
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
