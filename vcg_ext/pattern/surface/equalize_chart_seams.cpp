// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/charts_for_pattern.h"

#include <cmath>

#include "common/parallel.h"
#include "pattern/near_itself.h"
#include "planar/distortion.h"
#include "planar/overlap.h"
#include "surface/split_chart.h"

namespace dcharts {
namespace {

std::vector<int> BoundaryEdges(const ChartPatch& patch) {
  std::vector<int> edges;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h)
    if (patch.opposite[h] < 0) edges.push_back(h);
  return edges;
}

}  // namespace

FlatChart ChartsForPattern::ChartOf(const ChartPatch& patch) const {
  FlatChart chart;
  chart.mesh.triangles = patch.mesh.triangles;
  chart.mesh.positions = to_mm_ * patch.mesh.positions;
  chart.uv = to_mm_ * StoredUv(patch);
  return chart;
}

void ChartsForPattern::Finish(Finished& chart, const std::function<void()>& poll) const {
  chart.boundary = BoundaryEdges(chart.patch);
  chart.chart = ChartOf(chart.patch);
  const KeepInside keep =
      params_.material == PatternMaterial::kFabric ? KeepInside::kAngles : KeepInside::kLengths;
  chart.seams = EqualizeSeams(chart.boundary, keep, poll, chart.chart);
}

int ChartsForPattern::EqualizeAllSeams(ChartIds& ids, SeamMask& seams) {
  constexpr int kRounds = 12;
  std::vector<char> done(surface_.FaceCount(), 0);
  int left = 0;
  for (int round = 0; round <= kRounds; ++round) {
    std::vector<Finished> charts;
    {
      PatchExtractor<SurfaceMesh> extractor(surface_, seams);
      for (const auto& faces : FacesOfCharts(ids))
        if (!done[faces.front()] && !images_.Follows(faces.front()))
          charts.push_back({extractor.Extract(faces)});
    }
    if (charts.empty()) break;
    ParallelFor(static_cast<int>(charts.size()), progress_,
                [&](int k, const std::function<void()>& poll) { Finish(charts[k], poll); });
    int next_id = ChartCount(ids);
    for (const Finished& chart : charts) {
      // One that is its own image is parted into images.
      const auto part = [&](const auto& sides) {
        const int face = chart.patch.faces.front();
        if (images_.IsOwnImage(face))
          images_.PartAtPlane(surface_, ids[face], next_id++, ids, seams);
        else
          PartChart(chart.patch, sides(), next_id++, ids, seams);
      };
      if (!chart.seams.whole && round < kRounds) {
        if (SewUpCrossingDarts(chart, seams)) continue;
        FlatChart crossing = chart.chart;
        crossing.uv = chart.seams.uv;
        const auto overlaps = OverlappingPairs(OnGrid(crossing.uv, crossing.mesh.triangles), 100'000);
        if (!overlaps.empty()) {
          part([&] { return SplitAtOverlaps(chart.patch, overlaps); });
          continue;
        }
      }
      const auto meeting = round < kRounds ? MeetsItself(chart) : std::nullopt;
      if (meeting) {
        part([&] { return BisectBetween(chart.patch, meeting->first / 3, meeting->second / 3); });
        continue;
      }
      const bool may_part = chart.patch.faces.size() > 1;
      if (may_part && IsOffInArea(chart) && round < kRounds) {
        Store(chart.patch, chart.chart.uv / to_mm_);
        part([&] { return Bisect(chart.patch); });
        continue;
      }
      if (!chart.seams.whole) left += images_.IsFollowed(chart.patch.faces.front()) ? 2 : 1;
      Store(chart.patch, chart.chart.uv / to_mm_);
      for (int f : chart.patch.faces) done[f] = 1;
    }
    images_.Copy(ids, seams, wedge_);
    SplitAndCompact(surface_, ids, &seams);
  }
  return left;
}

std::optional<std::pair<int, int>> ChartsForPattern::MeetsItself(const Finished& chart) const {
  if (params_.material != PatternMaterial::kFabric || !(params_.seam_allowance > 0)) return std::nullopt;
  std::vector<char> in_chart(surface_.FaceCount(), 0), is_cut(chart.patch.HalfEdgeCount(), 0);
  for (int f : chart.patch.faces) in_chart[f] = 1;
  for (int h : chart.boundary) {
    const int g = surface_.Neighbour(chart.patch.SurfaceHalfEdge(h));
    is_cut[h] = g >= 0 && in_chart[g];
  }
  constexpr double kRoom = 1.25;  // allowances: below it is hard to cut
  auto meeting = NearItself(chart.chart, chart.boundary, is_cut, kRoom * params_.seam_allowance);
  if (meeting && meeting->first / 3 == meeting->second / 3) meeting.reset();
  return meeting;
}

bool ChartsForPattern::IsOffInArea(const Finished& chart) const {
  if (params_.material != PatternMaterial::kPaper) return false;
  constexpr double kMost = 0.03;
  const StretchFigures figures = MeasureStretch(chart.chart.mesh, chart.chart.uv);
  return std::abs(figures.UvArea() - figures.SurfaceArea()) > kMost * figures.SurfaceArea();
}

}  // namespace dcharts
