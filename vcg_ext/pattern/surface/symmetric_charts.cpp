// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/symmetric_charts.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "pattern/surface/charts_for_pattern.h"
#include "pattern/surface/join_at_plane.h"
#include "surface/chart_patch.h"
#include "surface/chart_trial.h"
#include "surface/cut.h"

namespace dcharts {
namespace {

using Surface = SurfaceGraph<SurfaceMesh>;

bool HasShorterSeamsInFirst(const Surface& surface, const MirroredHalves& halves, const ChartIds& ids) {
  double first = 0, second = 0;
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int g = surface.Neighbour(h);
    if (g >= 0 && ids[g] != ids[h / 3]) (halves.IsInFirst(h / 3) ? first : second) += surface.Length(h);
  }
  return first <= second;
}

/// The charts of one half of the surface, ended at the mirror plane.
class HalfCharts {
 public:
  HalfCharts(const Surface& surface, const MirroredHalves& halves, bool keep_first, double bound,
             Progress& progress)
      : surface_(surface), halves_(halves), keep_first_(keep_first), bound_(bound), progress_(progress) {}

  // The ids of the other half are left as images of these.
  void Run(ChartIds& ids) {
    std::vector<double> whole(ChartCount(ids), 0);
    for (int f = 0; f < surface_.FaceCount(); ++f) whole[ids[f]] += surface_.Area(f);
    const ChartIds old_ids = ids;
    const auto other_half = [&] {
      const int count = ChartCount(ids);
      for (int f = 0; f < surface_.FaceCount(); ++f)
        if (!IsKept(f)) ids[f] = count + ids[halves_.ImageOf(f)];
    };
    other_half();
    SplitAndCompact(surface_, ids);
    other_half();
    GiveAwayRests(whole, old_ids, ids);
    other_half();
    SplitAndCompact(surface_, ids);
  }

 private:
  bool IsKept(int face) const { return halves_.IsInFirst(face) == keep_first_; }

  // Parts of charts that are mostly elsewhere.
  void GiveAwayRests(const std::vector<double>& whole, const ChartIds& old_ids, ChartIds& ids) {
    constexpr double kRest = 0.4;                // one that the plane halves is no rest
    std::map<int, std::pair<double, int>> area;  // of the charts of the half, and their old ids
    for (int f = 0; f < surface_.FaceCount(); ++f) {
      if (!IsKept(f)) continue;
      area[ids[f]].first += surface_.Area(f);
      area[ids[f]].second = old_ids[f];
    }
    std::vector<std::pair<double, int>> rests;
    for (const auto& [id, part] : area)
      if (part.first < kRest * whole[part.second]) rests.push_back({part.first, id});
    std::sort(rests.begin(), rests.end());
    for (const auto& [size, id] : rests) GiveAway(id, ids);
  }

  void GiveAway(int id, ChartIds& ids) {
    progress_.Poll();
    std::map<int, double> border;
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int g = surface_.Neighbour(h);
      if (ids[h / 3] == id && g >= 0 && IsKept(g) && ids[g] != id) border[ids[g]] -= surface_.Length(h);
    }
    std::vector<std::pair<double, int>> longest_first;
    for (const auto& [neighbour, length] : border) longest_first.push_back({length, neighbour});
    std::sort(longest_first.begin(), longest_first.end());
    const SeamMask no_seams(surface_.FaceCount(), 0);
    PatchExtractor<SurfaceMesh> extractor(surface_, no_seams);
    for (const auto& [length, neighbour] : longest_first) {
      std::vector<int> faces;
      for (int f = 0; f < surface_.FaceCount(); ++f)
        if (ids[f] == id || ids[f] == neighbour) faces.push_back(f);
      if (!TryChart(extractor.Extract(faces), bound_, [&] { progress_.Poll(); }).flat) continue;
      for (int f : faces) ids[f] = neighbour;
      return;
    }
  }

  const Surface& surface_;
  const MirroredHalves& halves_;
  const bool keep_first_;
  const double bound_;
  Progress& progress_;
};

}  // namespace

bool MakeChartsSymmetric(const Surface& surface, const MirroredHalves& halves, const Params& params,
                         Progress& progress, ChartIds& ids, SeamMask& seams) {
  // What the plane leaves of a chart may stretch a little more than the chart: it is not to be cut for that.
  Params looser = params;
  constexpr double kLooser = 1.3;
  static_assert(kLooser < kImagesStretch);
  if (params.max_stretch > 0) looser.max_stretch = 1 + kLooser * (params.StretchBound() - 1);
  const bool keep_first = HasShorterSeamsInFirst(surface, halves, ids);
  ChartIds mirrored = ids;
  HalfCharts(surface, halves, keep_first, looser.StretchBound(), progress).Run(mirrored);
  SeamMask cut_seams;
  KnownFlattenings known;
  ChartCutter<SurfaceMesh>(surface, looser, progress).Run(ChartsFor::kPattern, mirrored, cut_seams, known);
  // What was cut, too, is that of one half.
  const int count = ChartCount(mirrored);
  for (int f = 0; f < surface.FaceCount(); ++f) {
    if (halves.IsInFirst(f) == keep_first) continue;
    mirrored[f] = count + mirrored[halves.ImageOf(f)];
    for (int h = 3 * f; h < 3 * f + 3; ++h) MarkSeam(cut_seams, h, IsSeam(cut_seams, halves.ImageOfEdge(h)));
  }
  SplitAndCompact(surface, mirrored, &cut_seams);
  JoinAtPlane(surface, halves, looser, progress, mirrored, cut_seams);
  constexpr int kFarTooMany = 2;  // pairs are not worth more than twice as many charts
  if (ChartCount(mirrored) > kFarTooMany * ChartCount(ids) + 1) return false;
  ids = std::move(mirrored);
  seams = std::move(cut_seams);
  return true;
}

}  // namespace dcharts
