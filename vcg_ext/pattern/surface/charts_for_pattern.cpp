// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/charts_for_pattern.h"

#include <algorithm>
#include <map>
#include <utility>

#include "common/parallel.h"
#include "planar/flatten.h"
#include "planar/overlap.h"
#include "surface/chart_patch.h"
#include "surface/parameterize.h"

namespace dcharts {
namespace {

// The two sides of a seam edge are no seam any more.
void ClearSeam(SeamMask& seams, int h) {
  seams[h / 3] = static_cast<std::uint8_t>(seams[h / 3] & ~(1 << (h % 3)));
}

// Edges (half-edges of the surface, one per edge) at which the chart's darts can be sewn up from their tips.
std::vector<std::vector<int>> EdgesToSewUp(const SurfaceGraph<SurfaceMesh>& surface, const ChartPatch& patch,
                                           const Points2& uv) {
  std::vector<int> leaving(patch.VertexCount(), -1), arriving(patch.VertexCount(), -1);
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    if (patch.opposite[h] >= 0) continue;
    leaving[patch.Vertex(h)] = h;
    arriving[patch.Vertex(Next(h))] = h;
  }
  // A gap this narrow, as a share of the length sewn up, is taken up by the fabric.
  constexpr double kNarrow = 0.08;
  std::vector<std::vector<int>> darts;
  for (int tip = 0; tip < patch.VertexCount(); ++tip) {
    std::vector<int> edges;
    double length = 0;
    size_t good = 0;
    for (int left = tip, right = tip;;) {
      const int in = arriving[left], out = leaving[right];
      if (in < 0 || out < 0 || surface.Opposite(patch.SurfaceHalfEdge(in)) != patch.SurfaceHalfEdge(out))
        break;
      edges.push_back(patch.SurfaceHalfEdge(in));
      length += patch.Length(in);
      left = patch.Vertex(in);
      right = patch.Vertex(Next(out));
      if ((uv.row(left) - uv.row(right)).norm() > kNarrow * length) break;
      good = edges.size();
      if (left == right) break;  // the other end of a slit
    }
    edges.resize(good);
    if (!edges.empty()) darts.push_back(std::move(edges));
  }
  return darts;
}

}  // namespace

Points2 ChartsForPattern::StoredUv(const ChartPatch& patch) const {
  Points2 uv(patch.VertexCount(), 2);
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    const auto& wedge = wedge_[patch.faces[h / 3]];
    uv.row(patch.Vertex(h)) << wedge[2 * (h % 3)], wedge[2 * (h % 3) + 1];
  }
  return uv;
}

void ChartsForPattern::Store(const ChartPatch& patch, const Points2& uv) {
  for (int h = 0; h < patch.HalfEdgeCount(); ++h)
    for (int d : {0, 1}) wedge_[patch.faces[h / 3]][2 * (h % 3) + d] = uv(patch.Vertex(h), d);
}

void ChartsForPattern::Flatten(ChartIds& ids, SeamMask& seams, const KnownFlattenings& known) {
  wedge_ = Parameterizer<SurfaceMesh>(surface_, params_, known, progress_).LayFlatApart(ids, seams);
  if (params_.material == PatternMaterial::kFabric) {
    const int shortened = ShortenDarts(ids, seams);
    if (shortened > 0) progress_.Log(std::to_string(shortened) + " darts were shortened.");
  }
  DropIneffectiveSeams(surface_, seams);
}

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
      const auto darts = EdgesToSewUp(surface_, patch, StoredUv(patch));
      if (darts.empty()) continue;
      Trial trial;
      trial.faces = faces;
      trial.darts = static_cast<int>(darts.size());
      for (const auto& dart : darts)
        for (int h : dart)
          for (int k : {h, surface_.Opposite(h)}) {
            trial.edges.push_back(k);
            ClearSeam(sewn, k);
          }
      trials.push_back(std::move(trial));
    }
  }
  PatchExtractor<SurfaceMesh> extractor(surface_, sewn);
  for (Trial& trial : trials) trial.patch = extractor.Extract(trial.faces);
  ParallelFor(static_cast<int>(trials.size()), progress_, [&](int k, const std::function<void()>& poll) {
    Trial& trial = trials[k];
    FlattenOptions options;
    options.method = params_.method;
    Flattening flat = dcharts::Flatten(trial.patch.mesh, options, poll);
    if (flat.ok && flat.note.empty() &&
        OverlappingPairs(OnGrid(flat.uv, trial.patch.mesh.triangles), 1).empty())
      trial.uv = std::move(flat.uv);
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

FlatCharts ChartsForPattern::Take(const ChartIds& ids, const SeamMask& seams, const SurfaceData& data,
                                  double data_to_mm, const std::vector<int>& source_face) const {
  FlatCharts result;
  PatchExtractor<SurfaceMesh> extractor(surface_, seams);
  std::vector<int> edge_of(surface_.HalfEdgeCount(), -1);
  std::map<std::pair<int, int>, int> border_edge;  // by its vertices
  for (const auto& faces : FacesOfCharts(ids)) {
    const ChartPatch patch = extractor.Extract(faces);
    FlatChart chart;
    chart.mesh.triangles = patch.mesh.triangles;
    chart.uv = to_mm_ * StoredUv(patch);
    chart.model_vertex.resize(patch.VertexCount());
    for (int h = 0; h < patch.HalfEdgeCount(); ++h)
      chart.model_vertex[patch.Vertex(h)] = surface_.Vertex(patch.SurfaceHalfEdge(h));
    chart.mesh.positions.resize(patch.VertexCount(), 3);
    for (int v = 0; v < patch.VertexCount(); ++v)
      for (int d = 0; d < 3; ++d)
        chart.mesh.positions(v, d) = data_to_mm * data.vertices[chart.model_vertex[v]][d];
    for (int f : faces) chart.source_face.push_back(source_face[f]);
    for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
      if (patch.opposite[h] >= 0) continue;
      const int s = patch.SurfaceHalfEdge(h), o = surface_.Opposite(s);
      int edge = -1;
      if (o >= 0) {
        edge = edge_of[o];
      } else {
        const auto key = std::minmax(surface_.Vertex(s), surface_.Vertex(Next(s)));
        const auto found = border_edge.find(key);
        if (found != border_edge.end()) edge = found->second;
        if (edge < 0) border_edge[key] = static_cast<int>(result.edges.size());
      }
      if (edge < 0) {
        edge = static_cast<int>(result.edges.size());
        result.edges.emplace_back();
      }
      edge_of[s] = edge;
      result.edges[edge].push_back({static_cast<int>(result.charts.size()), h});
    }
    result.charts.push_back(std::move(chart));
  }
  return result;
}

}  // namespace dcharts
