// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/join_at_plane.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/union_find.h"
#include "planar/flatten.h"
#include "planar/overlap.h"
#include "surface/chart_patch.h"
#include "surface/open_chart.h"
#include "surface/seams.h"
#include "surface/stretch_darts.h"

namespace dcharts {
namespace {

using Surface = SurfaceGraph<SurfaceMesh>;
using Poll = std::function<void()>;

/// Tries to make one chart of two that are each other's images.
class ImageJoiner {
 public:
  ImageJoiner(const Surface& surface, const MirroredHalves& halves, const Params& params,
              const SeamMask& seams)
      : surface_(surface), halves_(halves), params_(params), seams_(seams) {}

  /// `faces`: of one of the two. Returns the half-edges whose seam mark is to change; empty when they are not
  /// to be joined.
  std::vector<int> Run(const std::vector<int>& faces, const Poll& poll) const {
    const auto runs = RunsOnPlane(faces);
    std::vector<int> both = faces;
    for (int f : faces) both.push_back(halves_.ImageOf(f));
    std::sort(both.begin(), both.end());
    double area = 0;
    for (int f : both) area += surface_.Area(f);
    // All along the plane; else, where that makes a ring which does not lie flat, along its longest run.
    for (size_t count = runs.size(); count > 0; count = count > 1 ? 1 : 0) {
      std::vector<int> glued;
      double length = 0;
      for (size_t k = 0; k < count; ++k)
        for (int h : runs[k]) {
          glued.push_back(h);
          length += surface_.Length(h);
        }
      constexpr double kNeck = 0.2;  // a chart that hangs together by less is two
      if (length < kNeck * std::sqrt(area)) continue;
      std::vector<int> changed = Joined(both, glued, poll);
      if (!changed.empty()) return changed;
    }
    return {};
  }

 private:
  // The edges where the chart meets its image, by the lines they make; the longest first.
  std::vector<std::vector<int>> RunsOnPlane(const std::vector<int>& faces) const {
    std::map<int, int> vertex;
    std::vector<int> edges;
    for (int f : faces)
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        if (!halves_.IsOnPlane(surface_, h)) continue;
        edges.push_back(h);
        for (int v : {surface_.Vertex(h), surface_.Vertex(Next(h))})
          vertex.insert({v, static_cast<int>(vertex.size())});
      }
    UnionFind lines(static_cast<int>(vertex.size()));
    for (int h : edges) lines.Join(vertex[surface_.Vertex(h)], vertex[surface_.Vertex(Next(h))]);
    std::map<int, std::pair<double, std::vector<int>>> runs;
    for (int h : edges) {
      auto& run = runs[lines.Find(vertex[surface_.Vertex(h)])];
      run.first += surface_.Length(h);
      run.second.push_back(h);
    }
    std::vector<std::pair<double, std::vector<int>>> sorted;
    for (auto& entry : runs) sorted.push_back(std::move(entry.second));
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::vector<int>> result;
    for (auto& entry : sorted) result.push_back(std::move(entry.second));
    return result;
  }

  std::vector<int> Joined(const std::vector<int>& faces, const std::vector<int>& glued,
                          const Poll& poll) const {
    SeamMask seams = seams_;
    for (int h : glued)
      for (int side : {h, surface_.Opposite(h)}) ClearSeam(seams, side);
    const ChartPatch patch = PatchExtractor<SurfaceMesh>(surface_, seams).Extract(faces);
    if (!IsOpen(patch)) return {};
    const DartedChart darted = CutStretchDarts(patch, DartGoalOf(patch), poll);
    if (!darted.flat.ok) return {};
    for (const std::vector<int>& darts : SymmetricDarts(patch, darted.edges)) {
      SeamMask cut = seams;
      for (int h : darts) SetSeam(cut, h);
      const ChartPatch open = PatchExtractor<SurfaceMesh>(surface_, cut).Extract(faces);
      if (!IsWhole(open) || !IsOpen(open) ||
          !LiesFlat(open, darts.empty() && darted.edges.empty() ? &darted.flat : nullptr, poll))
        continue;
      std::vector<int> changed;
      for (int f : faces)
        for (int h = 3 * f; h < 3 * f + 3; ++h)
          if (IsSeam(cut, h) != IsSeam(seams_, h)) changed.push_back(h);
      return changed;
    }
    return {};
  }

  DartGoal DartGoalOf(const ChartPatch& patch) const {
    DartGoal goal;
    goal.l2_stretch = params_.StretchBound();
    goal.linf_stretch = kWorstStretch;
    if (params_.dart_by == DartMethod::kMeasuredStretch)
      goal.longest = params_.max_dart_percent / 100 * patch.Diagonal();
    goal.unit = std::sqrt(surface_.TotalArea());
    return goal;
  }

  // Those of either half with their images, and none, all as half-edges of the surface, both of each edge.
  std::vector<std::vector<int>> SymmetricDarts(const ChartPatch& patch, const std::vector<int>& edges) const {
    std::vector<std::vector<int>> choices;
    for (const bool first : {true, false}) {
      std::vector<int> darts;
      for (int edge : edges) {
        const int h = patch.SurfaceHalfEdge(edge);
        if (!halves_.IsOnPlane(surface_, h) && halves_.IsInFirst(h / 3) != first) continue;
        const int image = halves_.ImageOfEdge(h);
        for (int side : {h, surface_.Opposite(h), image, surface_.Opposite(image)}) darts.push_back(side);
      }
      if (!darts.empty()) choices.push_back(std::move(darts));
    }
    choices.emplace_back();
    return choices;
  }

  bool IsOpen(const ChartPatch& patch) const {
    return CutsThatOpenHandles(patch).empty() && CutsThatJoinLoops(patch, params_.cut_to_disk).empty();
  }

  static bool IsWhole(const ChartPatch& patch) {
    UnionFind faces(static_cast<int>(patch.faces.size()));
    int parts = static_cast<int>(patch.faces.size());
    for (int h = 0; h < patch.HalfEdgeCount(); ++h)
      if (patch.opposite[h] > h && faces.Find(h / 3) != faces.Find(patch.opposite[h] / 3)) {
        faces.Join(h / 3, patch.opposite[h] / 3);
        --parts;
      }
    return parts == 1;
  }

  bool LiesFlat(const ChartPatch& patch, const Flattening* known, const Poll& poll) const {
    FlattenOptions options;
    options.l2_bound = params_.StretchBound();
    Flattening flat = known ? *known : Flatten(patch.mesh, options, poll);
    if (!flat.ok || flat.l2_stretch > params_.StretchBound()) return false;
    if (params_.method != FlattenMethod::kStretchMinimizing) {
      options.method = params_.method;
      flat = Flatten(patch.mesh, options, poll);
    }
    return flat.ok && flat.note.empty() && !OverlapsItself(flat.uv, patch.mesh.triangles);
  }

  static constexpr double kWorstStretch = 1.3;  // what darts are to reach, as of all charts

  const Surface& surface_;
  const MirroredHalves& halves_;
  const Params& params_;
  const SeamMask& seams_;
};

}  // namespace

void JoinAtPlane(const Surface& surface, const MirroredHalves& halves, const Params& params,
                 Progress& progress, ChartIds& ids, SeamMask& seams) {
  std::vector<std::vector<int>> charts;
  for (auto& faces : FacesOfCharts(ids))
    if (halves.IsInFirst(faces.front())) charts.push_back(std::move(faces));
  std::vector<std::vector<int>> changed(charts.size());
  const ImageJoiner joiner(surface, halves, params, seams);
  ParallelFor(static_cast<int>(charts.size()), progress,
              [&](int k, const Poll& poll) { changed[k] = joiner.Run(charts[k], poll); });
  SeamMask joined = seams;
  for (size_t k = 0; k < charts.size(); ++k) {
    for (int h : changed[k]) MarkSeam(joined, h, !IsSeam(seams, h));
    if (changed[k].empty()) continue;
    for (int f : charts[k]) ids[halves.ImageOf(f)] = ids[f];
  }
  seams = std::move(joined);
  DropIneffectiveSeams(surface, seams);
  SplitAndCompact(surface, ids, &seams);
}

}  // namespace dcharts
