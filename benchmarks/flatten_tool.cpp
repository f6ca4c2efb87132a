// SPDX-License-Identifier: GPL-3.0-or-later
// The flattening alone, for measuring.
//   flatten_tool charts MESH OUT CHART_COUNT   segments and cuts the one mesh in MESH as the paper does, from
//                                              CHART_COUNT seeds, and writes its charts
//   flatten_tool target MESH OUT CHARTS        the same with the plugin's defaults and target_charts
//   flatten_tool flatten CHARTS OUT            flattens every chart; OUT holds for each: int32 ok, int32
//   number of
//                                              vertices, double cpu seconds, 2 doubles per vertex
//   flatten_tool conformal CHARTS OUT          the same, conformally
//   flatten_tool trial CHARTS L2_BOUND         trial flattening beside the full one, a line for each chart
// Files of charts are those of chart_file.h.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>

#include "chart_file.h"
#include "dcharts.h"
#include "planar/flatten.h"
#include "planar/trial_flatten.h"
#include "surface/chart_patch.h"
#include "surface/workspace.h"

namespace {

using dcharts::ChartMesh;
using dcharts::SurfaceChange;
using dcharts::SurfaceData;

SurfaceData SurfaceOf(const ChartMesh& mesh) {
  SurfaceData data;
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
    data.vertices.push_back({mesh.positions(v, 0), mesh.positions(v, 1), mesh.positions(v, 2)});
  }
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    data.faces.push_back({mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)});
  }
  return data;
}

// The stages of the paper, so that charts stay the same when defaults change.
dcharts::Params AsInThePaper(int chart_count) {
  dcharts::Params params;
  params.chart_count = chart_count;
  params.compactness_weight = 0.7;
  params.straightness_weight = 0.5;
  params.max_stretch = 0;
  params.straighten_by = dcharts::StraightenMethod::kShortestPath;
  params.merge_by = dcharts::MergeMethod::kBoundaryRegion;
  params.dart_by = dcharts::DartMethod::kFittingError;
  return params;
}

dcharts::Params Target(int charts) {
  dcharts::Params params;
  params.target_charts = charts;
  return params;
}

void WriteCharts(const std::string& in, const std::string& out, const dcharts::Params& params) {
  SurfaceData data = SurfaceOf(dcharts::bench::ReadCharts(in).at(0));
  dcharts::Progress progress;
  for (const auto stage :
       {dcharts::Segment, dcharts::Fill, dcharts::Straighten, dcharts::Merge, dcharts::Cut}) {
    const SurfaceChange change = stage(data, params, progress);
    data.face_quality.assign(change.chart_ids.begin(), change.chart_ids.end());
    data.seams = change.seams;
  }
  dcharts::Workspace work(data);
  dcharts::ChartIds ids = work.ReadCharts();
  dcharts::SeamMask seams;
  if (!work.ReadSeams(ids, seams)) throw std::runtime_error("The seams don't fit the charts.");
  dcharts::PatchExtractor<dcharts::SurfaceMesh> extractor(work.Surface(), seams);
  std::ofstream file(out, std::ios::binary);
  const auto charts = dcharts::FacesOfCharts(ids);
  for (const auto& faces : charts) dcharts::bench::WriteChart(file, extractor.Extract(faces).mesh);
  std::printf("%zu charts\n", charts.size());
}

void FlattenCharts(const std::string& in, const std::string& out, dcharts::FlattenMethod method) {
  dcharts::FlattenOptions options;
  options.method = method;
  std::ofstream file(out, std::ios::binary);
  double total = 0;
  for (const ChartMesh& chart : dcharts::bench::ReadCharts(in)) {
    const std::clock_t start = std::clock();
    dcharts::Flattening flat = dcharts::Flatten(chart, options);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (!flat.ok) flat.uv = dcharts::Points2::Zero(chart.positions.rows(), 2);
    const std::int32_t head[2] = {flat.ok, static_cast<std::int32_t>(flat.uv.rows())};
    dcharts::bench::WriteValues(file, head, 2);
    dcharts::bench::WriteValues(file, &seconds, 1);
    dcharts::bench::WriteValues(file, flat.uv.data(), flat.uv.size());
    std::printf("%7ld faces  L2 %.5f  Linf %.4f  %.4f s  %s%s\n", static_cast<long>(chart.triangles.rows()),
                flat.l2_stretch, flat.linf_stretch, seconds, flat.why.c_str(), flat.note.c_str());
    total += seconds;
  }
  std::printf("total %.3f s\n", total);
}

// Without writing: a line per chart, the trial beside the full flattening.
void TryCharts(const std::string& in, double l2_bound) {
  dcharts::TrialOptions options;
  options.l2_bound = l2_bound;
  double total = 0, total_full = 0;
  for (const ChartMesh& chart : dcharts::bench::ReadCharts(in)) {
    const std::clock_t start = std::clock();
    const dcharts::TrialFlattening trial = dcharts::TrialFlatten(chart, options);
    const std::clock_t middle = std::clock();
    const dcharts::Flattening flat = dcharts::Flatten(chart);
    const double seconds = static_cast<double>(middle - start) / CLOCKS_PER_SEC;
    const double full_seconds = static_cast<double>(std::clock() - middle) / CLOCKS_PER_SEC;
    std::printf(
        "%7ld faces  trial %s  L2 %.6f  Linf %.4f  %.4f s | full %s  L2 %.6f  Linf %.4f  %.4f s  %s\n",
        static_cast<long>(chart.triangles.rows()),
        trial.ok         ? "ok "
        : trial.rejected ? "rej"
                         : "no ",
        trial.l2_stretch, trial.linf_stretch, seconds, flat.ok ? "ok " : "no ", flat.l2_stretch,
        flat.linf_stretch, full_seconds, trial.why.c_str());
    total += seconds;
    total_full += full_seconds;
  }
  std::printf("trials %.3f s, full %.3f s\n", total, total_full);
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  try {
    if (words.size() == 4 && words[0] == "charts") {
      WriteCharts(words[1], words[2], AsInThePaper(std::atoi(words[3].c_str())));
    } else if (words.size() == 4 && words[0] == "target") {
      WriteCharts(words[1], words[2], Target(std::atoi(words[3].c_str())));
    } else if (words.size() == 3 && words[0] == "flatten") {
      FlattenCharts(words[1], words[2], dcharts::FlattenMethod::kStretchMinimizing);
    } else if (words.size() == 3 && words[0] == "conformal") {
      FlattenCharts(words[1], words[2], dcharts::FlattenMethod::kConformal);
    } else if (words.size() == 3 && words[0] == "trial") {
      TryCharts(words[1], std::atof(words[2].c_str()));
    } else {
      std::fputs(
          "usage: flatten_tool charts MESH OUT CHART_COUNT | target MESH OUT CHARTS | flatten CHARTS OUT | "
          "conformal CHARTS OUT | "
          "trial CHARTS L2_BOUND\n",
          stderr);
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
