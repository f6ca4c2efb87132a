// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/charts_for_pattern.h"

#include <algorithm>
#include <utility>

#include "common/parallel.h"
#include "pattern/equal_seams.h"
#include "pattern/surface/patch_darts.h"
#include "planar/flatten.h"
#include "planar/overlap.h"
#include "surface/charts.h"

namespace dcharts {
namespace {

// How many of the dart's edges lie side by side in the plane, from its tip on.
size_t EdgesSideBySide(const ChartPatch& patch, const PatchDart& dart, const Points2& uv) {
  // A gap this narrow, as a share of the length sewn up, is taken up by the fabric.
  constexpr double kNarrow = 0.08;
  double length = 0;
  for (size_t k = 0; k < dart.arriving.size(); ++k) {
    length += patch.Length(dart.arriving[k]);
    const Eigen::RowVector2d left = uv.row(patch.Vertex(dart.arriving[k])),
                             right = uv.row(patch.Vertex(Next(dart.leaving[k])));
    if ((left - right).norm() > kNarrow * length) return k;
  }
  return dart.arriving.size();
}

// Empty when there is no flat map without overlap, or not one of the kind asked for.
Points2 FlattenAnew(const ChartMesh& mesh, FlattenMethod method, const std::function<void()>& poll) {
  FlattenOptions options;
  options.method = method;
  Flattening flat = Flatten(mesh, options, poll);
  if (!flat.ok || !flat.note.empty() || OverlapsItself(flat.uv, mesh.triangles)) return {};
  return std::move(flat.uv);
}

}  // namespace

int ChartsForPattern::ShortenDarts(const ChartIds& ids, SeamMask& seams) {
  struct Trial {
    std::vector<int> faces;
    std::vector<int> edges;
    int darts = 0;
    ChartPatch patch;
    Points2 uv;
  };
  std::vector<Trial> trials;
  SeamMask sewn = seams;
  {
    PatchExtractor<SurfaceMesh> extractor(surface_, seams);
    for (const auto& faces : FacesOfCharts(ids)) {
      const ChartPatch patch = extractor.Extract(faces);
      const Points2 uv = StoredUv(patch);
      Trial trial;
      trial.faces = faces;
      for (const PatchDart& dart : DartsOf(surface_, patch)) {
        const size_t count = EdgesSideBySide(patch, dart, uv);
        trial.darts += count > 0;
        for (size_t k = 0; k < count; ++k)
          for (int h : {dart.arriving[k], dart.leaving[k]}) trial.edges.push_back(patch.SurfaceHalfEdge(h));
      }
      KeepImages(trial.faces.front(), trial.edges);
      for (int h : trial.edges) ClearSeam(sewn, h);
      if (trial.darts > 0) trials.push_back(std::move(trial));
    }
  }
  PatchExtractor<SurfaceMesh> extractor(surface_, sewn);
  for (Trial& trial : trials) trial.patch = extractor.Extract(trial.faces);
  ParallelFor(static_cast<int>(trials.size()), progress_, [&](int k, const std::function<void()>& poll) {
    Trial& trial = trials[k];
    trial.uv = FlattenAnew(trial.patch.mesh, params_.method, poll);
  });
  int count = 0;
  for (const Trial& trial : trials) {
    if (trial.uv.rows() == 0) continue;
    for (int h : trial.edges) ClearSeam(seams, h);
    Store(trial.patch, trial.uv);
    count += trial.darts;
  }
  return count;
}

void ChartsForPattern::KeepImages(int face, std::vector<int>& edges) const {
  if (!images_.IsOwnImage(face)) return;
  std::vector<int> sorted = edges;
  std::sort(sorted.begin(), sorted.end());
  edges.erase(std::remove_if(edges.begin(), edges.end(),
                             [&](int h) {
                               const int image = images_.Halves().ImageOfEdge(h);
                               return !std::binary_search(sorted.begin(), sorted.end(), image);
                             }),
              edges.end());
}

bool ChartsForPattern::SewUpCrossingDarts(const Finished& chart, SeamMask& seams) {
  FlatChart crossing = chart.chart;
  crossing.uv = chart.seams.uv;
  std::vector<char> crosses(chart.patch.HalfEdgeCount(), 0);
  for (int h : CrossingEdges(crossing, chart.boundary)) crosses[h] = 1;
  std::vector<int> sewn;
  for (const PatchDart& dart : DartsOf(surface_, chart.patch)) {
    size_t count = 0;
    for (size_t k = 0; k < dart.arriving.size(); ++k)
      if (crosses[dart.arriving[k]] || crosses[dart.leaving[k]]) count = k + 1;
    for (size_t k = 0; k < count; ++k)
      for (int h : {dart.arriving[k], dart.leaving[k]}) {
        crosses[h] = 0;
        sewn.push_back(chart.patch.SurfaceHalfEdge(h));
      }
  }
  if (sewn.empty() || std::find(crosses.begin(), crosses.end(), 1) != crosses.end()) return false;
  SeamMask trial = seams;
  const bool with_images = images_.IsOwnImage(chart.patch.faces.front());
  for (int h : sewn) {
    ClearSeam(trial, h);
    if (with_images) ClearSeam(trial, images_.Halves().ImageOfEdge(h));
  }
  const ChartPatch patch = PatchExtractor<SurfaceMesh>(surface_, trial).Extract(chart.patch.faces);
  const Points2 uv = FlattenAnew(patch.mesh, params_.method, [&] { progress_.Poll(); });
  if (uv.rows() == 0) return false;
  seams = std::move(trial);
  Store(patch, uv);
  return true;
}

}  // namespace dcharts
