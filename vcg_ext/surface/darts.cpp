// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/darts.h"

#include <algorithm>
#include <cmath>

#include "surface/open_chart.h"
#include "surface/patch_paths.h"

namespace dcharts {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A place that should be relieved.
struct Target {
  int vertex;
  double need;  // larger is served first
};

// Vertices of faces that fit badly. A face or two is noise: the region must have some area.
void AddErrorTargets(const ChartPatch& patch, const std::vector<double>& fitting_error, double bound,
                     std::vector<Target>& targets) {
  constexpr double kSmallestRegion = 1e-3;  // of the chart's area
  const int face_count = static_cast<int>(patch.faces.size());
  const double chart_area = patch.Area();
  std::vector<char> visited(face_count, 0);
  std::vector<double> need(patch.VertexCount(), 0);
  for (int start = 0; start < face_count; ++start) {
    if (visited[start] || !(fitting_error[start] > bound)) continue;
    std::vector<int> region{start};
    visited[start] = 1;
    double area = 0;
    for (size_t k = 0; k < region.size(); ++k) {
      const int f = region[k];
      const Eigen::Vector3d a = patch.mesh.positions.row(patch.mesh.triangles(f, 0)),
                            b = patch.mesh.positions.row(patch.mesh.triangles(f, 1)),
                            c = patch.mesh.positions.row(patch.mesh.triangles(f, 2));
      area += (b - a).cross(c - a).norm() / 2;
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = patch.opposite[h] < 0 ? -1 : patch.opposite[h] / 3;
        if (g < 0 || visited[g] || !(fitting_error[g] > bound)) continue;
        visited[g] = 1;
        region.push_back(g);
      }
    }
    if (area < kSmallestRegion * chart_area) continue;
    for (int f : region)
      for (int i = 0; i < 3; ++i) need[patch.mesh.triangles(f, i)] += fitting_error[f];
  }
  for (int v = 0; v < patch.VertexCount(); ++v)
    if (need[v] > 0) targets.push_back({v, need[v]});
}

// Vertices with concentrated curvature: much of it, or much more than the vertices around (a cone's apex on
// an otherwise developable chart).
void AddApexTargets(const ChartPatch& patch, const PatchPaths& paths, std::vector<Target>& targets) {
  constexpr double kSpike = 1.0, kApex = 0.05, kStandsOut = 10;  // radians, radians, ratio
  std::vector<double> defect = AngleSums(patch);
  for (int v = 0; v < patch.VertexCount(); ++v)
    defect[v] = paths.OnBoundary(v) ? 0 : std::abs(2 * kPi - defect[v]);
  std::vector<double> around(patch.VertexCount(), 0);
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    const int v = patch.Vertex(h), w = patch.Vertex(Next(h));
    around[v] = std::max(around[v], defect[w]);
    around[w] = std::max(around[w], defect[v]);
  }
  for (int v = 0; v < patch.VertexCount(); ++v)
    if (defect[v] > kSpike || (defect[v] > kApex && defect[v] > kStandsOut * around[v]))
      targets.push_back({v, 10 * defect[v]});
}

}  // namespace

Darts PlanDarts(const ChartPatch& patch, const std::vector<double>& fitting_error, const Params& params) {
  Darts darts;
  if (params.max_dart_percent <= 0) return darts;
  PatchPaths paths(patch);
  std::vector<int> sources;
  for (int v = 0; v < patch.VertexCount(); ++v)
    if (paths.OnBoundary(v)) sources.push_back(v);
  std::vector<Target> targets;
  AddErrorTargets(patch, fitting_error, params.dart_fitting_error, targets);
  AddApexTargets(patch, paths, targets);
  if (targets.empty()) return darts;
  std::stable_sort(targets.begin(), targets.end(),
                   [](const Target& a, const Target& b) { return a.need > b.need; });

  const Eigen::RowVector3d size =
      patch.mesh.positions.colwise().maxCoeff() - patch.mesh.positions.colwise().minCoeff();
  const double longest = params.max_dart_percent / 100 * size.norm();
  std::vector<char> relieved(patch.VertexCount(), 0);
  paths.Run(sources, true);
  PatchPaths disk(patch);
  for (const Target& target : targets) {
    const int tip = target.vertex;
    const double length = paths.Distance(tip);
    if (relieved[tip] || length <= 0 || length > longest) continue;
    std::vector<int> path = paths.Path(tip);
    for (int v = tip; paths.From(v) >= 0; v = paths.Before(v)) sources.push_back(v);
    darts.edges.insert(darts.edges.end(), path.begin(), path.end());
    ++darts.count;
    disk.Run({tip}, false);
    for (int v = 0; v < patch.VertexCount(); ++v)
      if (disk.Distance(v) <= length) relieved[v] = 1;
    paths.Run(sources, true);  // the new cut is boundary from now on
  }
  return darts;
}

}  // namespace dcharts
