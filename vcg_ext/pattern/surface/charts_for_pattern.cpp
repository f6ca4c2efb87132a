// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/charts_for_pattern.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "common/parallel.h"
#include "pattern/equal_seams.h"
#include "pattern/least_piece.h"
#include "pattern/near_itself.h"
#include "pattern/surface/patch_darts.h"
#include "planar/distortion.h"
#include "planar/flatten.h"
#include "planar/overlap.h"
#include "surface/chart_patch.h"
#include "surface/parameterize.h"
#include "surface/split_chart.h"

namespace dcharts {
namespace {

// The two sides of a seam edge are no seam any more.
void ClearSeam(SeamMask& seams, int h) {
  seams[h / 3] = static_cast<std::uint8_t>(seams[h / 3] & ~(1 << (h % 3)));
}

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

std::vector<int> BoundaryEdges(const ChartPatch& patch) {
  std::vector<int> edges;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h)
    if (patch.opposite[h] < 0) edges.push_back(h);
  return edges;
}

// Empty when there is no flat map without overlap, or not one of the kind asked for.
Points2 FlattenAnew(const ChartMesh& mesh, FlattenMethod method, const std::function<void()>& poll) {
  FlattenOptions options;
  options.method = method;
  Flattening flat = Flatten(mesh, options, poll);
  if (!flat.ok || !flat.note.empty() || !OverlappingPairs(OnGrid(flat.uv, mesh.triangles), 1).empty())
    return {};
  return std::move(flat.uv);
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
  images_.Pair(ids);
  // Charts are as flat as they are to be; images of some stretch a little more than they.
  Params flatten = params_;
  if (flatten.max_stretch > 0) flatten.max_stretch = 1 + kImagesStretch * (params_.StretchBound() - 1);
  wedge_ = Parameterizer<SurfaceMesh>(surface_, flatten, known, progress_).LayFlatApart(ids, seams);
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
          for (int h : {dart.arriving[k], dart.leaving[k]}) {
            trial.edges.push_back(patch.SurfaceHalfEdge(h));
            ClearSeam(sewn, trial.edges.back());
          }
      }
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

struct ChartsForPattern::Finished {
  ChartPatch patch{};
  FlatChart chart{};
  std::vector<int> boundary{};
  EqualSeams seams{};
};

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
      if (!chart.seams.whole && round < kRounds) {
        if (SewUpCrossingDarts(chart, seams)) continue;
        FlatChart crossing = chart.chart;
        crossing.uv = chart.seams.uv;
        const auto overlaps = OverlappingPairs(OnGrid(crossing.uv, crossing.mesh.triangles), 100'000);
        if (!overlaps.empty()) {
          PartChart(chart.patch, SplitAtOverlaps(chart.patch, overlaps), next_id++, ids, seams);
          continue;
        }
      }
      const auto meeting = round < kRounds ? MeetsItself(chart) : std::nullopt;
      if (meeting) {
        PartChart(chart.patch, BisectBetween(chart.patch, meeting->first / 3, meeting->second / 3), next_id++,
                  ids, seams);
        continue;
      }
      const bool may_part = chart.patch.faces.size() > 1;
      if (may_part && IsOffInArea(chart) && round < kRounds) {
        Store(chart.patch, chart.chart.uv / to_mm_);
        PartChart(chart.patch, Bisect(chart.patch), next_id++, ids, seams);
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

double ChartsForPattern::UselessArea() const { return LeastPieceArea(params_) / (to_mm_ * to_mm_); }

int ChartsForPattern::JoinSmallCharts(ChartIds& ids, SeamMask& seams) {
  constexpr double kSmallShare = 0.005;  // of the model's area
  const double least = std::max(UselessArea(), kSmallShare * surface_.TotalArea());
  constexpr int kMostCharts = 100, kMostNeighbours = 3;  // bound the time
  const auto charts = FacesOfCharts(ids);
  std::vector<double> area(charts.size(), 0);
  for (int f = 0; f < surface_.FaceCount(); ++f) area[ids[f]] += surface_.Area(f);
  std::vector<int> small;
  for (int c = 0; c < static_cast<int>(charts.size()); ++c)
    if (area[c] < least) small.push_back(c);
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
  if (!OverlappingPairs(OnGrid(flat.uv, patch.mesh.triangles), 1).empty()) return false;
  seams = std::move(joined);
  for (int f : faces) ids[f] = other;
  Store(patch, flat.uv);
  return true;
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
  for (int h : sewn) ClearSeam(trial, h);
  const ChartPatch patch = PatchExtractor<SurfaceMesh>(surface_, trial).Extract(chart.patch.faces);
  const Points2 uv = FlattenAnew(patch.mesh, params_.method, [&] { progress_.Poll(); });
  if (uv.rows() == 0) return false;
  seams = std::move(trial);
  Store(patch, uv);
  return true;
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
