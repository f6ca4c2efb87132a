// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/charts_for_pattern.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "surface/parameterize.h"

namespace dcharts {

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

void ChartsForPattern::LayFlat(ChartIds& ids, SeamMask& seams, const KnownFlattenings& known) {
  // Charts are as flat as they are to be; images of some stretch a little more than they.
  Params flatten = params_;
  if (flatten.max_stretch > 0) flatten.max_stretch = 1 + kImagesStretch * (params_.StretchBound() - 1);
  for (;;) {
    images_.Pair(ids);
    ChartIds flat_ids = ids;
    SeamMask flat_seams = seams;
    wedge_ =
        Parameterizer<SurfaceMesh>(surface_, flatten, known, progress_).LayFlatApart(flat_ids, flat_seams);
    // Charts that are their own images and were cut are parted at the plane first.
    std::vector<int> cut;
    for (int f = 0; f < surface_.FaceCount(); ++f)
      if (images_.IsOwnImage(f) && (flat_ids[f] != ids[f] || flat_seams[f] != seams[f]))
        cut.push_back(ids[f]);
    if (cut.empty()) {
      ids = std::move(flat_ids);
      seams = std::move(flat_seams);
      return;
    }
    std::sort(cut.begin(), cut.end());
    cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
    int next_id = ChartCount(ids);
    for (int id : cut) images_.PartAtPlane(surface_, id, next_id++, ids, seams);
    SplitAndCompact(surface_, ids, &seams);
  }
}

void ChartsForPattern::Flatten(ChartIds& ids, SeamMask& seams, const KnownFlattenings& known) {
  LayFlat(ids, seams, known);
  const auto follow = [&] {
    images_.Copy(ids, seams, wedge_);
    SplitAndCompact(surface_, ids, &seams);
    images_.Pair(ids);
  };
  follow();
  if (params_.material == PatternMaterial::kFabric) {
    const int shortened = ShortenDarts(ids, seams);
    follow();
    if (shortened > 0) progress_.Log(std::to_string(shortened) + " darts were shortened.");
  }
  DropIneffectiveSeams(surface_, seams);
  int joined = JoinSmallCharts(ids, seams), left = EqualizeAllSeams(ids, seams);
  // Where charts had to be parted, small ones may be there anew.
  const int joined_again = JoinSmallCharts(ids, seams);
  if (joined_again > 0) left = EqualizeAllSeams(ids, seams);
  joined += joined_again;
  if (joined > 0)
    progress_.Log(std::to_string(joined) + " pieces too small to work with were joined to others.");
  if (left > 0)
    progress_.Log("The seams of " + std::to_string(left) +
                  " pieces could not be made equally long: see the ease of the seams.");
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
        const int v = surface_.Vertex(s), w = surface_.Vertex(Next(s));
        const std::pair<int, int> key(std::min(v, w), std::max(v, w));
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
