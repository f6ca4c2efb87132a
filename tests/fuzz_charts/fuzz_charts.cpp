// SPDX-License-Identifier: GPL-3.0-or-later
// Flattens random charts, by both methods, and makes atlases of them: no flipped triangle, no overlap,
// nothing that isn't finite; a chart may be refused with a reason. Prints a line for each kind of chart and
// one for each failure, with the seed that makes it again. usage: fuzz_charts FIRST_SEED COUNT
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "dcharts.h"
#include "planar/flatten.h"
#include "planar/overlap.h"
#include "random_charts.h"

namespace {

using dcharts::ChartMesh;

struct Tally {
  int charts = 0, refused = 0, atlases_refused = 0, failures = 0;
  double slowest = 0;
  unsigned long long slowest_seed = 0;
};

double SurfaceArea(const ChartMesh& chart, Eigen::Index t) {
  const Eigen::Vector3d a = chart.positions.row(chart.triangles(t, 0)),
                        b = chart.positions.row(chart.triangles(t, 1)),
                        c = chart.positions.row(chart.triangles(t, 2));
  const Eigen::Vector3d e = b - a, f = c - a;
  return Eigen::Vector3d(e.y() * f.z() - e.z() * f.y(), e.z() * f.x() - e.x() * f.z(),
                         e.x() * f.y() - e.y() * f.x())
             .norm() /
         2;
}

/// Empty, or what is wrong with a flattening that says it is good.
std::string WrongWith(const ChartMesh& chart, const dcharts::Flattening& flat) {
  if (flat.uv.rows() != chart.positions.rows() || !flat.uv.allFinite())
    return "UVs are missing or not finite";
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    const Eigen::RowVector2d a = flat.uv.row(chart.triangles(t, 0)),
                             e = flat.uv.row(chart.triangles(t, 1)) - a,
                             f = flat.uv.row(chart.triangles(t, 2)) - a;
    if (!(e.x() * f.y() - e.y() * f.x() > 0)) return "triangle " + std::to_string(t) + " is flipped";
  }
  if (!(flat.l2_stretch >= 1 - 1e-9) || !std::isfinite(flat.l2_stretch) ||
      !std::isfinite(flat.linf_stretch)) {
    return "stretch is not finite";
  }
  return {};
}

/// The same for an atlas. Texcoords are floats on a grid of 2^-24 or coarser, on which all tests are exact.
std::string WrongWith(const ChartMesh& chart, const dcharts::SurfaceChange& change) {
  std::vector<dcharts::GridTriangle> grid;
  double total_area = 0;
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) total_area += SurfaceArea(chart, t);
  for (std::size_t t = 0; t < change.wedge_texcoords.size(); ++t) {
    dcharts::GridTriangle triangle{};
    for (std::size_t k = 0; k < 6; ++k) {
      const double x = change.wedge_texcoords[t][k];
      if (!(x >= 0 && x <= 1)) return "a texcoord is not in [0, 1]";
      triangle[k] = static_cast<std::int32_t>(std::ldexp(x, 24));
      if (std::ldexp(static_cast<double>(triangle[k]), -24) != x) return "a texcoord is finer than 2^-24";
    }
    const std::int64_t area = dcharts::TwiceArea(triangle);
    const bool counts = SurfaceArea(chart, static_cast<Eigen::Index>(t)) > 1e-12 * total_area;
    if (area < 0 || (area == 0 && counts)) return "face " + std::to_string(t) + " is flipped in the atlas";
    grid.push_back(triangle);
  }
  if (grid.size() != static_cast<std::size_t>(chart.triangles.rows())) return "texcoords are missing";
  const auto pairs = dcharts::OverlappingPairs(grid, 1);
  if (!pairs.empty()) {
    return "faces " + std::to_string(pairs[0].first) + " and " + std::to_string(pairs[0].second) + " overlap";
  }
  return {};
}

dcharts::SurfaceData OneChart(const ChartMesh& chart) {
  dcharts::SurfaceData data;
  for (Eigen::Index v = 0; v < chart.positions.rows(); ++v) {
    data.vertices.push_back({chart.positions(v, 0), chart.positions(v, 1), chart.positions(v, 2)});
  }
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    data.faces.push_back({chart.triangles(t, 0), chart.triangles(t, 1), chart.triangles(t, 2)});
  }
  data.face_quality.assign(data.faces.size(), 0);
  data.seams.assign(data.faces.size(), 0);
  return data;
}

void Fail(unsigned long long seed, const dcharts::fuzz::RandomChart& chart, const std::string& what,
          Tally& tally) {
  ++tally.failures;
  std::printf("seed %llu (%s, %ld faces): %s\n", seed, NameOf(chart.kind),
              static_cast<long>(chart.mesh.triangles.rows()), what.c_str());
  std::fflush(stdout);
}

void Try(unsigned long long seed, std::array<Tally, dcharts::fuzz::kChartKinds>& tallies) {
  const dcharts::fuzz::RandomChart chart = dcharts::fuzz::MakeRandomChart(seed);
  Tally& tally = tallies[static_cast<std::size_t>(chart.kind)];
  const auto start = std::chrono::steady_clock::now();
  ++tally.charts;
  bool refused = false;
  for (const auto method : {dcharts::FlattenMethod::kStretchMinimizing, dcharts::FlattenMethod::kConformal}) {
    dcharts::FlattenOptions options;
    options.method = method;
    const dcharts::Flattening flat = dcharts::Flatten(chart.mesh, options);
    if (flat.ok) {
      const std::string wrong = WrongWith(chart.mesh, flat);
      if (!wrong.empty()) Fail(seed, chart, wrong, tally);
    } else if (flat.why.empty()) {
      Fail(seed, chart, "refused without a reason", tally);
    } else {
      refused = true;
    }
  }
  if (refused) ++tally.refused;
  try {
    dcharts::Progress progress;
    const std::string wrong =
        WrongWith(chart.mesh, dcharts::Parameterize(OneChart(chart.mesh), dcharts::Params(), progress));
    if (!wrong.empty()) Fail(seed, chart, wrong, tally);
  } catch (const dcharts::Error& error) {
    ++tally.atlases_refused;
    std::printf("seed %llu (%s): refused: %s\n", seed, NameOf(chart.kind), error.what());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (seconds > tally.slowest) {
    tally.slowest = seconds;
    tally.slowest_seed = seed;
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fputs("usage: fuzz_charts FIRST_SEED COUNT\n", stderr);
    return 2;
  }
  const unsigned long long first = std::strtoull(arguments[1], nullptr, 10);
  const unsigned long long charts = std::strtoull(arguments[2], nullptr, 10);
  std::array<Tally, dcharts::fuzz::kChartKinds> tallies;
  for (unsigned long long seed = first; seed < first + charts; ++seed) Try(seed, tallies);
  int failures = 0;
  for (int kind = 0; kind < dcharts::fuzz::kChartKinds; ++kind) {
    const Tally& tally = tallies[static_cast<std::size_t>(kind)];
    std::printf(
        "%-14s %6d charts, %5d refused by the flattening, %d by the filter, %d failures, slowest %.2f s "
        "(seed "
        "%llu)\n",
        dcharts::fuzz::NameOf(static_cast<dcharts::fuzz::ChartKind>(kind)), tally.charts, tally.refused,
        tally.atlases_refused, tally.failures, tally.slowest, tally.slowest_seed);
    failures += tally.failures;
  }
  return failures > 0 ? 1 : 0;
}
