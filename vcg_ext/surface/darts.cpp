// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/darts.h"

#include <algorithm>
#include <cmath>

#include "common/pi.h"
#include "surface/open_chart.h"
#include "surface/patch_paths.h"

namespace dcharts {
namespace {

/// A part of the chart that won't lie flat: the vertices a dart may run to, and the curvature that is to be
/// let out.
struct Region {
  std::vector<int> vertices;
  double curvature = 0;  // sum of angle defects, radians; negative for a saddle, which needs a gusset
  bool apex = false;     // one vertex holds the curvature: only a cut that ends there lets it out
};

// 2 pi less the angle sum inside, 0 on the boundary.
std::vector<double> AngleDefects(const ChartPatch& patch, const PatchPaths& paths) {
  std::vector<double> defect = AngleSums(patch);
  for (int v = 0; v < patch.VertexCount(); ++v) defect[v] = paths.OnBoundary(v) ? 0 : 2 * kPi - defect[v];
  return defect;
}

// Connected faces that fit badly and hold enough area and curvature to be worth a cut.
void AddErrorRegions(const ChartPatch& patch, const std::vector<double>& fitting_error, double bound,
                     const std::vector<double>& defect, std::vector<Region>& regions) {
  constexpr double kSmallest = 1e-3;  // of the chart's area
  // Radians. A gusset makes the plane overlap itself, which costs a chart more: only for a deep saddle.
  constexpr double kDart = 0.3, kGusset = -1.5;
  const int face_count = static_cast<int>(patch.faces.size());
  const double chart_area = patch.Area();
  std::vector<char> visited(face_count, 0);
  std::vector<int> seen(patch.VertexCount(), -1);
  for (int start = 0; start < face_count; ++start) {
    if (visited[start] || !(fitting_error[start] > bound)) continue;
    std::vector<int> faces{start};
    visited[start] = 1;
    Region region;
    double area = 0;
    for (size_t k = 0; k < faces.size(); ++k) {
      area += patch.FaceArea(faces[k]);
      for (int h = 3 * faces[k]; h < 3 * faces[k] + 3; ++h) {
        const int v = patch.Vertex(h);
        if (seen[v] != start) {
          seen[v] = start;
          region.vertices.push_back(v);
          region.curvature += defect[v];
        }
        const int g = patch.opposite[h] < 0 ? -1 : patch.opposite[h] / 3;
        if (g < 0 || visited[g] || !(fitting_error[g] > bound)) continue;
        visited[g] = 1;
        faces.push_back(g);
      }
    }
    if (area >= kSmallest * chart_area && (region.curvature >= kDart || region.curvature <= kGusset))
      regions.push_back(std::move(region));
  }
}

// Vertices with concentrated curvature: much of it, or much more than the vertices around (a cone's apex on
// an otherwise developable chart).
void AddApexes(const ChartPatch& patch, const std::vector<double>& defect, std::vector<Region>& regions) {
  constexpr double kSpike = 1.0, kApex = 0.05, kStandsOut = 10;  // radians, radians, ratio
  std::vector<double> around(patch.VertexCount(), 0);
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    const int v = patch.Vertex(h), w = patch.Vertex(Next(h));
    around[v] = std::max(around[v], std::abs(defect[w]));
    around[w] = std::max(around[w], std::abs(defect[v]));
  }
  for (int v = 0; v < patch.VertexCount(); ++v) {
    const double d = std::abs(defect[v]);
    if (d > kSpike || (d > kApex && d > kStandsOut * around[v])) regions.push_back({{v}, defect[v], true});
  }
}

}  // namespace

Darts PlanDarts(const ChartPatch& patch, const std::vector<double>& fitting_error, const Params& params) {
  Darts darts;
  if (params.max_dart_percent <= 0) return darts;
  PatchPaths paths(patch), disk(patch);
  std::vector<int> sources = paths.BoundaryVertices();
  const std::vector<double> defect = AngleDefects(patch, paths);
  std::vector<Region> regions;
  AddErrorRegions(patch, fitting_error, params.dart_fitting_error, defect, regions);
  AddApexes(patch, defect, regions);
  if (regions.empty()) return darts;
  std::stable_sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) {
    return std::abs(a.curvature) > std::abs(b.curvature);
  });

  const Eigen::RowVector3d size =
      patch.mesh.positions.colwise().maxCoeff() - patch.mesh.positions.colwise().minCoeff();
  const double longest = params.max_dart_percent / 100 * size.norm();
  constexpr double kShortest = 0.05;  // of the chart's size: what a shorter cut relieves is not worth a seam
  const double shortest = kShortest * std::sqrt(patch.Area());
  std::vector<char> relieved(patch.VertexCount(), 0);
  paths.Run(sources, true);
  for (const Region& region : regions) {
    for (;;) {
      // The tip goes to the innermost vertex that no dart has relieved yet.
      int tip = -1;
      for (int v : region.vertices) {
        const double d = paths.Distance(v);
        const bool wanted = region.apex ? d > 0 : !relieved[v] && d >= shortest;
        if (wanted && d <= longest && (tip < 0 || d > paths.Distance(tip))) tip = v;
      }
      if (tip < 0) break;
      const double length = paths.Distance(tip);
      const std::vector<int> path = paths.Path(tip);
      for (int v = tip; paths.From(v) >= 0; v = paths.Before(v)) sources.push_back(v);
      darts.edges.insert(darts.edges.end(), path.begin(), path.end());
      ++darts.count;
      disk.Run({tip}, false);
      for (int v = 0; v < patch.VertexCount(); ++v)
        if (disk.Distance(v) <= length) relieved[v] = 1;
      paths.Run(sources, true);  // the new cut is boundary from now on
    }
  }
  return darts;
}

}  // namespace dcharts
