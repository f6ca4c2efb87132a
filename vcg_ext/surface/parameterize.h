// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "common/parallel.h"
#include "common/params.h"
#include "common/progress.h"
#include "planar/coarser_charts.h"
#include "planar/distortion.h"
#include "planar/flatten.h"
#include "planar/lay_apart.h"
#include "planar/overlap.h"
#include "planar/packing.h"
#include "planar/trial_flatten.h"
#include "surface/carried_map.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/known_flattenings.h"
#include "surface/merge.h"
#include "surface/needed_cuts.h"
#include "surface/open_chart.h"
#include "surface/patch_paths.h"
#include "surface/rounding.h"
#include "surface/seams.h"
#include "surface/slits.h"
#include "surface/split_chart.h"
#include "surface/texel_density.h"

namespace dcharts {

/// Flattens every chart, removes overlaps by cutting (Section 4, "Fixing gussets and overlaps"), and packs.
template <class MeshType>
class Parameterizer {
 public:
  /// `known`: flattenings that Cut has made.
  Parameterizer(const SurfaceGraph<MeshType>& surface, const Params& params, const KnownFlattenings& known,
                Progress& progress)
      : surface_(surface), params_(params), known_(known), progress_(progress), wedge_(surface.FaceCount()) {}

  /// `seams` must agree with `ids`. Both change where a chart had to be cut or split. Returns finished
  /// texcoords. `face_density`: per face its texels per length beside other faces, of which a chart gets the
  /// mean; empty = all alike.
  WedgeTexcoords Run(ChartIds& ids, SeamMask& seams, const std::vector<double>& face_density) {
    LayFlatApart(ids, seams);
    // Rounding to the texture's grid may show an overlap that wasn't there before. Each attempt halves the
    // charts with one.
    constexpr int kAttempts = 10;
    for (int attempt = 0;; ++attempt) {
      if (attempt > 0) FlattenAll(ids, seams);
      WedgeTexcoords uv;
      const std::vector<int> bad_charts = PackAndRound(ids, seams, face_density, uv);
      if (bad_charts.empty() || attempt == kAttempts) {
        if (!bad_charts.empty())
          progress_.Log(
              "Some faces are too thin for float texture coordinates; see flipped_faces and "
              "overlapping_faces.");
        LogNotes(ids);
        return uv;
      }
      for (int f = 0; f < surface_.FaceCount(); ++f)
        if (std::binary_search(bad_charts.begin(), bad_charts.end(), ids[f])) state_[f] = State::kToBisect;
    }
  }

  /// What Run does before it packs: every chart is flat without overlap. Returns, per face, u0 v0 u1 v1 u2
  /// v2, each chart in a frame of its own, at the surface's scale.
  const std::vector<std::array<double, 6>>& LayFlatApart(ChartIds& ids, SeamMask& seams) {
    OpenHandles(surface_, progress_, ids, seams);
    all_disks_ = AllDisks(ids, seams);
    state_.assign(surface_.FaceCount(), State::kToFlatten);
    splits_.assign(surface_.FaceCount(), 0);
    cut_off_.assign(surface_.FaceCount(), 0);
    note_of_.assign(surface_.FaceCount(), -1);
    FlattenAll(ids, seams);
    RejoinCutOffs(ids, seams);
    return wedge_;
  }

 private:
  enum class State : char { kDone, kToFlatten, kToCheck, kToBisect };

  struct Piece {
    ChartPatch patch;
    Points2 uv{};
    bool flat = false;
    std::vector<std::pair<int, int>> overlaps{};
    std::string why{};
    std::string note{};  // why it has the least stretch instead of being conformal
    double l2_stretch = 1;
    bool is_new = false;  // `uv` is not what is stored of it
  };

  bool AllDisks(const ChartIds& ids, const SeamMask& seams) const {
    const std::vector<ChartPatch> patches =
        PatchExtractor<MeshType>(surface_, seams).ExtractAll(FacesOfCharts(ids));
    return std::all_of(patches.begin(), patches.end(),
                       [](const ChartPatch& patch) { return LoopsOf(patch).size() == 1; });
  }

  // Until every chart is flat without overlap. Each round makes the charts that are not smaller or cuts them
  // open, so it ends: a single face is always flat.
  void FlattenAll(ChartIds& ids, SeamMask& seams) {
    for (;;) {
      const SeamMask before = seams;
      const auto charts = FacesOfCharts(ids, [&](int f) { return state_[f] != State::kDone; });
      if (charts.empty()) return;
      std::vector<Piece> pieces;
      for (ChartPatch& patch : PatchExtractor<MeshType>(surface_, before).ExtractAll(charts))
        pieces.push_back({std::move(patch)});

      ParallelForLargestFirst(
          static_cast<int>(pieces.size()), progress_, [&](int k) { return pieces[k].patch.faces.size(); },
          [&](int k, const std::function<void()>& poll) { FlattenPiece(pieces[k], poll); });
      int next_id = ChartCount(ids);
      for (Piece& piece : pieces) Settle(piece, ids, seams, next_id);
      SplitAndCompact(surface_, ids, &seams);
    }
  }

  void FlattenPiece(Piece& piece, const std::function<void()>& poll) const {
    const State state = state_[piece.patch.faces.front()];
    if (state == State::kToBisect) return;
    if (state == State::kToCheck) {
      piece.uv = StoredUv(piece.patch);
      piece.flat = true;
      piece.l2_stretch = MeasureStretch(piece.patch.mesh, piece.uv).L2();
      if (IsAboveBound(piece)) {
        LayFlat(piece, params_.method, poll);
      }
    } else {
      if (all_disks_ && LoopsOf(piece.patch).size() > 1) return;  // a part of a disk must become a disk again
      LayFlat(piece, params_.method, poll);
    }
    if (piece.flat) piece.overlaps = OverlapsInMap(piece.uv, piece.patch.mesh.triangles, kMostOverlaps, poll);
    if (!piece.overlaps.empty() && state == State::kToFlatten && MayDrawApart()) DrawApart(piece, poll);
  }

  // That costs some stretch. With a number of charts to keep to there is no need: what is cut off finds
  // another chart.
  bool MayDrawApart() const {
    return params_.method == FlattenMethod::kStretchMinimizing && params_.target_charts == 0;
  }

  // Where that is enough, nothing has to be cut off.
  void DrawApart(Piece& piece, const std::function<void()>& poll) const {
    std::optional<ApartMap> apart =
        LayApart(piece.patch.mesh, piece.uv, params_.StretchBound(), ApartMapFor::kAtlas, poll,
                 known_.FindCoarser(piece.patch).get());
    if (!apart && !IsLargeChart(piece.patch.mesh)) {  // from the map that Merge has tried
      const TrialFlattening flat = TrialFlatten(piece.patch.mesh, {}, poll);
      if (flat.ok)
        apart = LayApart(piece.patch.mesh, flat.uv, params_.StretchBound(), ApartMapFor::kAtlas, poll);
    }
    if (!apart) return;
    piece.is_new = true;
    piece.uv = std::move(apart->uv);
    piece.l2_stretch = apart->l2_stretch;
    piece.overlaps.clear();
  }

  // Without a number of charts to keep to, no chart is to be above params.max_stretch.
  bool IsAboveBound(const Piece& piece) const {
    return params_.method == FlattenMethod::kStretchMinimizing && params_.target_charts == 0 &&
           piece.l2_stretch > params_.StretchBound();
  }

  void LayFlat(Piece& piece, FlattenMethod method, const std::function<void()>& poll) const {
    FlattenOptions options;
    options.method = method;
    options.l2_bound = params_.StretchBound();
    const Flattening* known =
        method == FlattenMethod::kStretchMinimizing ? known_.Find(piece.patch) : nullptr;
    Flattening flat = known ? *known : Flatten(piece.patch.mesh, options, poll);
    piece.is_new = true;
    piece.flat = flat.ok;
    piece.why = std::move(flat.why);
    piece.note = std::move(flat.note);
    piece.uv = std::move(flat.uv);
    piece.l2_stretch = flat.l2_stretch;
    if (piece.flat)
      OpenSlits(piece.patch, SurfaceVertices(piece.patch), kSlitGap * std::sqrt(piece.patch.Area()),
                piece.uv);
  }

  std::vector<int> SurfaceVertices(const ChartPatch& patch) const {
    std::vector<int> vertex(patch.VertexCount());
    for (int h = 0; h < patch.HalfEdgeCount(); ++h)
      vertex[patch.Vertex(h)] = surface_.Vertex(patch.SurfaceHalfEdge(h));
    return vertex;
  }

  Points2 StoredUv(const ChartPatch& patch) const {
    Points2 uv(patch.VertexCount(), 2);
    for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
      const auto& wedge = wedge_[patch.faces[h / 3]];
      uv.row(patch.Vertex(h)) << wedge[2 * (h % 3)], wedge[2 * (h % 3) + 1];
    }
    return uv;
  }

  void Store(const Piece& piece) {
    for (int f : piece.patch.faces) note_of_[f] = static_cast<int>(notes_.size());
    notes_.push_back(piece.note);
    for (int h = 0; h < piece.patch.HalfEdgeCount(); ++h) {
      auto& wedge = wedge_[piece.patch.faces[h / 3]];
      wedge[2 * (h % 3)] = piece.uv(piece.patch.Vertex(h), 0);
      wedge[2 * (h % 3) + 1] = piece.uv(piece.patch.Vertex(h), 1);
    }
  }

  void LogNotes(const ChartIds& ids) {
    std::vector<int> of_chart(ChartCount(ids), -1);
    for (int f = 0; f < surface_.FaceCount(); ++f)
      if (note_of_[f] >= 0 && !notes_[note_of_[f]].empty()) of_chart[ids[f]] = note_of_[f];
    for (size_t c = 0; c < of_chart.size(); ++c)
      if (of_chart[c] >= 0) progress_.Log("chart " + std::to_string(c) + ": " + notes_[of_chart[c]] + ".");
  }

  // Keeps a good piece, cuts or splits another.
  void Settle(const Piece& piece, ChartIds& ids, SeamMask& seams, int& next_id) {
    const ChartPatch& patch = piece.patch;
    if (piece.flat && IsAboveBound(piece) && patch.faces.size() > 1) {
      SplitPiece(patch, Bisect(patch, [this] { progress_.Poll(); }), State::kToFlatten, ids, seams, next_id);
      return;
    }
    if (piece.flat && piece.overlaps.empty()) {
      // One that kept its place has it stored already, with the note on how it was flattened.
      if (piece.is_new) Store(piece);
      for (int f : patch.faces) state_[f] = State::kDone;
      return;
    }
    if (piece.flat) {
      // After some tries the parts keep the places they have: then each split removes overlaps for good.
      // Large charts, which take long, do so at once.
      constexpr int kFreshTries = 3;
      const bool inherit = ++splits_[patch.faces.front()] > kFreshTries || IsLargeChart(patch.mesh);
      for (int f : patch.faces) splits_[f] = splits_[patch.faces.front()];
      if (inherit && piece.is_new) Store(piece);
      SplitPiece(patch, SplitAtOverlaps(patch, piece.overlaps), inherit ? State::kToCheck : State::kToFlatten,
                 ids, seams, next_id);
      MarkCutOff(patch, ids);
      return;
    }
    if (!piece.why.empty())
      progress_.Log("A chart of " + std::to_string(patch.faces.size()) +
                    " faces is cut or split: " + piece.why);
    if (state_[patch.faces.front()] != State::kToBisect && LoopsOf(patch).size() > 1) {
      MarkCuts(surface_, patch, CutsThatJoinLoops(patch, true), seams);
      return;
    }
    if (patch.faces.size() == 1) {  // no triangle refuses to lie flat, but one without any extent may
      constexpr double kTiny = 1e-6;
      if (state_[patch.faces.front()] != State::kToBisect)
        wedge_[patch.faces.front()] = {0, 0, kTiny, 0, 0, kTiny};
      state_[patch.faces.front()] = State::kDone;
      return;
    }
    SplitPiece(patch, Bisect(patch, [this] { progress_.Poll(); }), State::kToFlatten, ids, seams, next_id);
  }

  void SplitPiece(const ChartPatch& patch, const std::vector<int>& side, State next, ChartIds& ids,
                  SeamMask& seams, int& next_id) {
    for (int f : patch.faces) state_[f] = next;
    PartChart(patch, side, next_id++, ids, seams);
  }

  // Of a chart split at an overlap, the smaller part may be joined to another chart.
  void MarkCutOff(const ChartPatch& patch, const ChartIds& ids) {
    std::map<int, double> area;
    for (int f : patch.faces) area[ids[f]] += surface_.Area(f);
    const auto larger =
        std::max_element(area.begin(), area.end(), [](auto& a, auto& b) { return a.second < b.second; });
    for (int f : patch.faces) cut_off_[f] = ids[f] != larger->first;
  }

  // "The resulting small charts are merged with neighbors if the merging criterion is satisfied and the merge
  // itself does not create new overlaps."
  void RejoinCutOffs(ChartIds& ids, SeamMask& seams) {
    if (std::find(cut_off_.begin(), cut_off_.end(), 1) == cut_off_.end()) return;
    BoundaryRegion<MeshType> region(surface_);
    const auto charts = FacesOfCharts(ids);
    std::vector<double> area(charts.size(), 0);
    for (int f = 0; f < surface_.FaceCount(); ++f) area[ids[f]] += surface_.Area(f);
    for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
      const std::vector<int>& faces = charts[c];
      if (ids[faces.front()] != c ||
          !std::all_of(faces.begin(), faces.end(), [&](int f) { return cut_off_[f] == 1; }))
        continue;
      progress_.Poll();
      std::map<int, std::pair<double, std::vector<int>>> borders;  // neighbour: length, faces on both sides
      for (int f : faces)
        for (int h = 3 * f; h < 3 * f + 3; ++h) {
          const int g = surface_.Neighbour(h);
          if (g < 0 || ids[g] == c) continue;
          auto& border = borders[ids[g]];
          border.first += surface_.Length(h);
          border.second.push_back(f);
          border.second.push_back(g);
        }
      std::vector<std::pair<double, int>> longest_first;
      for (const auto& b : borders) longest_first.push_back({-b.second.first, b.first});
      std::sort(longest_first.begin(), longest_first.end());
      for (const auto& [length, d] : longest_first) {
        const double error = region.Error(ids, c, d, borders[d].second, std::min(area[c], area[d]));
        // Parameterize has no merge_threshold of its own: stage by stage must give what the one-shot filter
        // gives.
        if (error < Params().merge_threshold && TryJoin(c, d, ids, seams)) {
          area[d] += area[c];
          break;
        }
      }
    }
    SplitAndCompact(surface_, ids, &seams);
  }

  // The piece is a large chart that is stored, `host`, and a little more: that is laid beside it.
  void LayBeside(const ChartPatch& host, Piece& piece, const std::function<void()>& poll) const {
    const Points2 start = CarriedMap(host, StoredUv(host), piece.patch);
    TrialOptions options;
    options.start = &start;
    TrialFlattening flat = TrialFlatten(piece.patch.mesh, options, poll);
    piece.is_new = true;
    piece.flat = flat.ok;
    piece.uv = std::move(flat.uv);
    piece.l2_stretch = flat.l2_stretch;
  }

  // Chart c becomes part of d if the union lies flat without overlap.
  bool TryJoin(int c, int d, ChartIds& ids, SeamMask& seams) {
    SeamMask joined = seams;
    std::vector<int> faces;
    for (int f = 0; f < surface_.FaceCount(); ++f) {
      if (ids[f] != c && ids[f] != d) continue;
      faces.push_back(f);
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h);
        if (g >= 0 && ids[g] != ids[f] && (ids[g] == c || ids[g] == d)) ClearSeam(joined, h);
      }
    }
    Piece piece{PatchExtractor<MeshType>(surface_, joined).Extract(faces)};
    const size_t loops = LoopsOf(piece.patch).size();
    if (loops == 0 || !CutsThatOpenHandles(piece.patch).empty() || (all_disks_ && loops > 1)) return false;
    const auto poll = [&] { progress_.Poll(); };
    if (IsLargeChart(piece.patch.mesh)) {
      std::vector<int> host;
      for (int f : faces)
        if (ids[f] == d) host.push_back(f);
      LayBeside(PatchExtractor<MeshType>(surface_, seams).Extract(host), piece, poll);
    } else {
      LayFlat(piece, FlattenMethod::kStretchMinimizing, poll);
    }
    constexpr double kWorthIt = 1.02;
    if (!piece.flat || piece.l2_stretch > std::min(kWorthIt, params_.StretchBound())) return false;
    if (params_.method != FlattenMethod::kStretchMinimizing) LayFlat(piece, params_.method, poll);
    if (!piece.flat) return false;
    if (OverlapsItself(piece.uv, piece.patch.mesh.triangles)) return false;
    Store(piece);
    seams = std::move(joined);
    for (int f : faces) {
      ids[f] = d;
      cut_off_[f] = 0;
    }
    return true;
  }

  // Places all charts in the unit square on the texcoord grid. Returns the charts that overlap or flip there,
  // sorted.
  std::vector<int> PackAndRound(const ChartIds& ids, const SeamMask& seams,
                                const std::vector<double>& face_density, WedgeTexcoords& uv) {
    const int chart_count = ChartCount(ids);
    std::vector<double> density = ChartDensities(surface_, ids, face_density);
    EnlargeTinyCharts(ids, density);
    std::vector<std::vector<double>> rows(chart_count);
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      if (surface_.Opposite(h) >= 0 && !IsSeam(seams, h)) continue;
      auto& r = rows[ids[h / 3]];
      for (int k : {h % 3, Next(h) % 3})
        for (int d : {0, 1}) r.push_back(density[ids[h / 3]] * wedge_[h / 3][2 * k + d]);
    }
    std::vector<Points2> outlines;
    for (const auto& r : rows)
      outlines.push_back(Eigen::Map<const Points2>(r.data(), static_cast<Eigen::Index>(r.size() / 2), 2));
    const Packing packing =
        Pack(outlines, {params_.texture_size, params_.padding, params_.rotate}, [&] { progress_.Poll(); });
    if (packing.padding < params_.padding)
      progress_.Log("There are too many charts for the padding asked for: they are " +
                    std::to_string(packing.padding) + " texels apart.");

    const CutVertices cut = OpenAtSeams(surface_, seams);
    std::vector<std::int32_t> x(cut.count), y(cut.count);
    std::vector<Eigen::Matrix2d> turn(chart_count);
    for (int c = 0; c < chart_count; ++c) {
      const double angle = packing.placements[c].angle;
      turn[c] << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    }
    auto to_grid = [](double t) {
      return static_cast<std::int32_t>(std::lround(std::clamp(t, 0.0, 1.0) * kTexcoordGrid));
    };
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int c = ids[h / 3];
      const Eigen::Vector2d p(wedge_[h / 3][2 * (h % 3)], wedge_[h / 3][2 * (h % 3) + 1]);
      const Eigen::Vector2d q = packing.scale * (turn[c] * (density[c] * p)) + packing.placements[c].offset;
      x[cut.of_corner[h]] = to_grid(q.x());
      y[cut.of_corner[h]] = to_grid(q.y());
    }
    progress_.Poll();
    std::vector<int> bad;
    for (int f : MendRoundedTriangles(cut.of_corner, x, y))
      if (surface_.Area(f) > 0) bad.push_back(ids[f]);
    std::vector<GridTriangle> grid(surface_.FaceCount());
    uv.resize(surface_.FaceCount());
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int v = cut.of_corner[h], k = 2 * (h % 3);
      grid[h / 3][k] = x[v];
      grid[h / 3][k + 1] = y[v];
      uv[h / 3][k] = static_cast<float>(x[v] / kTexcoordGrid);
      uv[h / 3][k + 1] = static_cast<float>(y[v] / kTexcoordGrid);
    }
    for (const auto& [i, j] : OverlappingPairs(grid, kMostOverlaps, [&] { progress_.Poll(); })) {
      bad.push_back(ids[i]);
      bad.push_back(ids[j]);
    }
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    return bad;
  }

  // A chart that is hardly larger than a step of the texcoords' grid would be crumpled by rounding: it gets
  // more texels. It has next to no area, so no figure changes. The surface's area is 1.
  void EnlargeTinyCharts(const ChartIds& ids, std::vector<double>& density) const {
    constexpr double kLeastSize = 2e-4;  // about 2000 steps
    std::vector<Eigen::AlignedBox2d> box(density.size());
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h)
      box[ids[h / 3]].extend(Eigen::Vector2d(wedge_[h / 3][2 * (h % 3)], wedge_[h / 3][2 * (h % 3) + 1]));
    for (size_t c = 0; c < density.size(); ++c) {
      const double size = box[c].diagonal().norm();
      if (size > 0) density[c] = std::max(density[c], kLeastSize / size);
    }
  }

  static constexpr size_t kMostOverlaps = 500'000;
  static constexpr double kSlitGap = 1e-6;  // of the chart's size

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  const KnownFlattenings& known_;
  Progress& progress_;
  bool all_disks_ = false;
  std::vector<std::array<double, 6>>
      wedge_;                       // of finished charts, each in its own frame, at the surface's scale
  std::vector<std::string> notes_;  // on how charts were flattened
  std::vector<int> note_of_;        // per face, -1 before it was flattened
  std::vector<State> state_;        // the same for all faces of a chart
  std::vector<int> splits_;         // how often the face's chart was split because of overlaps
  std::vector<char> cut_off_;       // the face belongs to a part that was cut off because of an overlap
};

}  // namespace dcharts
