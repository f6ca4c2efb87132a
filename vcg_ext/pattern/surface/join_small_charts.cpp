// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/charts_for_pattern.h"

#include <algorithm>
#include <map>
#include <utility>

#include "pattern/least_piece.h"
#include "planar/flatten.h"
#include "planar/overlap.h"
#include "surface/charts.h"

namespace dcharts {

double ChartsForPattern::UselessArea() const { return LeastPieceArea(params_) / (to_mm_ * to_mm_); }

int ChartsForPattern::JoinSmallCharts(ChartIds& ids, SeamMask& seams) {
  constexpr double kSmallShare = 0.005;  // of the model's area
  const double least = std::max(UselessArea(), kSmallShare * surface_.TotalArea());
  constexpr int kMostCharts = 100, kMostNeighbours = 3;  // bound the time
  const auto charts = FacesOfCharts(ids);
  std::vector<double> area(charts.size(), 0), around(charts.size(), 0);
  for (int f = 0; f < surface_.FaceCount(); ++f) area[ids[f]] += surface_.Area(f);
  for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
    const int g = surface_.Neighbour(h);
    if (g < 0 || ids[g] != ids[h / 3]) around[ids[h / 3]] += surface_.Length(h);
  }
  std::vector<int> small;
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    const bool is_narrow = 2 * area[c] < around[c] * LeastPieceWidth(params_) / to_mm_;  // a strip, about
    if (area[c] < least || is_narrow) small.push_back(c);
  }
  std::stable_sort(small.begin(), small.end(), [&](int a, int b) { return area[a] < area[b]; });
  if (small.size() > kMostCharts) small.resize(kMostCharts);
  int joined = 0;
  for (int c : small) {
    progress_.Poll();
    std::map<int, double> border;  // 3D length by neighbour
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int g = surface_.Neighbour(h);
      if (ids[h / 3] == c && g >= 0 && ids[g] != c) border[ids[g]] -= surface_.Length(h);
    }
    std::vector<std::pair<double, int>> longest_first;
    for (const auto& [id, length] : border) longest_first.push_back({length, id});
    std::sort(longest_first.begin(), longest_first.end());
    if (longest_first.size() > kMostNeighbours) longest_first.resize(kMostNeighbours);
    int joined_now = 0;
    for (const auto& [length, d] : longest_first)
      if (joined_now == 0) joined_now = JoinWithImages(c, d, ids, seams);
    // A pair is given up only for one that can't be sewn.
    for (const auto& [length, d] : longest_first)
      if (joined_now == 0 && images_.IsSymmetric() && area[c] < UselessArea())
        joined_now = TryJoin(c, d, ids, seams);
    joined += joined_now;
  }
  SplitAndCompact(surface_, ids, &seams);
  images_.Pair(ids);
  return joined;
}

int ChartsForPattern::JoinWithImages(int small, int other, ChartIds& ids, SeamMask& seams) {
  if (!images_.IsSymmetric()) return TryJoin(small, other, ids, seams);
  const int small_image = images_.ImageChart(ids, small), other_image = images_.ImageChart(ids, other);
  if (small_image < 0 || other_image < 0) return 0;
  if (small_image == other || (small_image == small && other_image == other))
    return TryJoin(small, other, ids, seams);
  const ChartIds ids_before = ids;
  const SeamMask seams_before = seams;
  const std::vector<FaceUv> wedge_before = wedge_;
  // One that is its own image goes to both, half by half.
  const int half = small_image == small ? images_.TakeApart(surface_, small, other, ids, seams) : small_image;
  if (TryJoin(small, other, ids, seams) && TryJoin(half, other_image, ids, seams))
    return small_image == small ? 1 : 2;
  ids = ids_before;
  seams = seams_before;
  wedge_ = wedge_before;
  return 0;
}

bool ChartsForPattern::TryJoin(int small, int other, ChartIds& ids, SeamMask& seams) {
  SeamMask joined = seams;
  std::vector<int> faces;
  for (int f = 0; f < surface_.FaceCount(); ++f) {
    if (ids[f] != small && ids[f] != other) continue;
    faces.push_back(f);
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int g = surface_.Neighbour(h);
      if (g >= 0 && ids[g] != ids[f] && (ids[g] == small || ids[g] == other)) ClearSeam(joined, h);
    }
  }
  const ChartPatch patch = PatchExtractor<SurfaceMesh>(surface_, joined).Extract(faces);
  FlattenOptions options;
  options.method = params_.method;
  const Flattening flat = dcharts::Flatten(patch.mesh, options, [&] { progress_.Poll(); });
  // A small part may stretch more than the rest: fabric gives, and a speck of paper is no worse than a gap.
  // One that nobody can sew or fold is worse than a little more.
  constexpr double kFabricGives = 0.02, kPaperGives = 0.0001, kForUseless = 5;
  double area = 0;
  for (int f : faces) area += ids[f] == small ? surface_.Area(f) : 0;
  const double gives = params_.material == PatternMaterial::kFabric ? kFabricGives : kPaperGives;
  const double bound =
      std::max(params_.StretchBound(), 1 + (area < UselessArea() ? kForUseless * gives : gives));
  if (!flat.ok || !flat.note.empty() || flat.l2_stretch > bound) return false;
  if (OverlapsItself(flat.uv, patch.mesh.triangles)) return false;
  seams = std::move(joined);
  for (int f : faces) ids[f] = other;
  Store(patch, flat.uv);
  return true;
}

}  // namespace dcharts
