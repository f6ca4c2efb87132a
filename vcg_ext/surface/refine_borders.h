// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/params.h"
#include "common/progress.h"
#include "planar/coarser_charts.h"
#include "planar/lay_apart.h"
#include "planar/normalized_chart.h"
#include "planar/overlap.h"
#include "planar/trial_flatten.h"
#include "surface/border_graph_cut.h"
#include "surface/carried_map.h"
#include "surface/chart_trial.h"
#include "surface/known_trials.h"
#include "surface/map_pricing.h"
#include "surface/seam_price.h"

namespace dcharts {

/// Moves the borders of merged charts to where seams are shorter and charts lie flatter. Charts are
/// flattened, and graph cuts through bands around their borders weigh seam length against the stretch in
/// those maps; as a map that is merely continued costs more than a new one, every step lowers the true cost.
template <class MeshType>
class BorderRefiner {
 public:
  BorderRefiner(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface),
        params_(params),
        progress_(progress),
        no_seams_(surface.FaceCount(), 0),
        unit_(std::sqrt(surface.TotalArea())),
        pricing_(surface) {}

  /// Every face must have a chart, and every chart be one piece; charts keep their ids. None comes to be
  /// above params.max_stretch that was not, or to overlap itself.
  /// `known`: trials of charts of this surface.
  void Run(const KnownTrials& known, ChartIds& ids) {
    constexpr int kMostSweeps = 3;
    constexpr double kLittle = 0.003;
    const int count = ChartCount(ids);
    std::vector<int> all(count);
    for (int c = 0; c < count; ++c) all[c] = c;
    State now{ids, std::vector<Chart>(count)};
    Flatten(all, known, now);
    double cost = Cost(now);
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      progress_.Update(static_cast<double>(sweep + 1) / (kMostSweeps + 1));
      State next = Moved(now);
      const double new_cost = Cost(next);
      if (new_cost >= cost) return;
      const bool go_on = cost - new_cost > kLittle * cost;
      now = std::move(next);
      ids = now.ids;
      cost = new_cost;
      if (!go_on) return;
    }
  }

 private:
  struct Chart {
    bool good = false;  // flat, with no more stretch than it may have
    ChartPatch patch{};
    Points2 uv{};
    double stretch = 0, cost = 0;  // without its borders
  };
  struct State {
    ChartIds ids;
    std::vector<Chart> charts;
  };

  double SeamCost(double length) const { return params_.seam_weight * kSeamPrice * length / unit_; }

  double Cost(const State& state) const {
    double cost = 0, length = 0;
    for (const Chart& chart : state.charts) cost += chart.cost;
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h)
      if (surface_.Opposite(h) > h && state.ids[surface_.Neighbour(h)] != state.ids[h / 3])
        length += surface_.Length(h);
    return cost + SeamCost(length);
  }

  State Moved(const State& now) {
    BorderCutOptions options;
    options.length_weight = params_.seam_weight * kSeamPrice;
    options.max_sweeps = 1;
    pricing_.Maps().Forget();
    for (int c = 0; c < static_cast<int>(now.charts.size()); ++c)
      if (now.charts[c].good) pricing_.Maps().Set(c, now.charts[c].patch, now.charts[c].uv);
    ChartIds ids = now.ids;
    BorderGraphCut<MeshType, MapPricing<MeshType>>(surface_, options, pricing_, progress_).Run(ids);
    // Charts that came out bad get their faces back, and give back what they got, until all are good. That
    // may take others to pieces, or all they have.
    const auto is_any = [](const std::vector<bool>& charts) {
      return std::find(charts.begin(), charts.end(), true) != charts.end();
    };
    for (;;) {
      std::vector<bool> bad = ChartsNotInOnePiece(surface_, ids, static_cast<int>(now.charts.size()));
      if (!is_any(bad)) {
        State next{ids, now.charts};
        Flatten(Changed(now.ids, ids), {}, next);
        for (size_t c = 0; c < bad.size(); ++c) bad[c] = now.charts[c].good && !next.charts[c].good;
        if (!is_any(bad)) return next;
      }
      bool returned = false;
      for (size_t f = 0; f < ids.size(); ++f)
        if (ids[f] != now.ids[f] && (bad[ids[f]] || bad[now.ids[f]])) {
          ids[f] = now.ids[f];
          returned = true;
        }
      if (!returned) return now;
    }
  }

  static std::vector<int> Changed(const ChartIds& before, const ChartIds& after) {
    std::vector<int> charts;
    for (size_t f = 0; f < before.size(); ++f)
      if (before[f] != after[f]) charts.insert(charts.end(), {before[f], after[f]});
    std::sort(charts.begin(), charts.end());
    charts.erase(std::unique(charts.begin(), charts.end()), charts.end());
    return charts;
  }

  void Flatten(const std::vector<int>& which, const KnownTrials& known, State& state) {
    auto faces = FacesOfCharts(state.ids);
    std::vector<std::vector<int>> charts;
    for (int c : which) charts.push_back(std::move(faces[c]));
    const std::vector<ChartPatch> patches = PatchExtractor<MeshType>(surface_, no_seams_).ExtractAll(charts);
    const auto size = [&](int k) { return patches[k].faces.size(); };
    const auto flatten = [&](int k, const std::function<void()>& poll) {
      Chart& chart = state.charts[which[k]];
      // Without a number of charts to keep to, one above the bound needs the darts that it was tried with.
      const bool may_exceed = chart.patch.faces.empty() && params_.target_charts > 0;
      const double bound = std::max(params_.StretchBound(), chart.stretch);
      double cut_length = 0;
      ChartPatch patch = Opened(patches[k], cut_length);
      TrialOptions options;
      Points2 start;
      if (chart.uv.rows() > 0) {
        start = CarriedMap(chart.patch, chart.uv, patch);
        options.start = &start;
      }
      chart.patch = std::move(patch);
      std::optional<CoarserCharts> coarser;
      if (IsLargeChart(chart.patch.mesh)) options.coarser = &coarser.emplace(Normalized(chart.patch.mesh));
      const TrialFlattening* found = options.start ? nullptr : known.Find(patches[k].faces);
      TrialFlattening flat = found ? *found : TrialFlatten(chart.patch.mesh, options, poll);
      chart.good = flat.ok && (may_exceed || flat.l2_stretch <= bound);
      if (chart.good && OverlapsItself(flat.uv, chart.patch.mesh.triangles))
        chart.good = params_.target_charts == 0 && DrawApart(chart.patch.mesh, bound, options, poll, flat);
      chart.cost = flat.energy * chart.patch.Area() / surface_.TotalArea() + SeamCost(cut_length);
      chart.stretch = flat.l2_stretch;
      chart.uv = std::move(flat.uv);
    };
    ParallelForLargestFirst(static_cast<int>(which.size()), progress_, size, flatten);
  }

  // As Merge may have done it. Where the chart has a map from before, its parts are apart there but for what
  // came to them: fewer steps draw that apart than a map anew, whose parts lap over each other again.
  static bool DrawApart(const ChartMesh& mesh, double bound, const TrialOptions& options,
                        const std::function<void()>& poll, TrialFlattening& flat) {
    const auto from = [&](const Points2& uv) {
      return LayApart(mesh, uv, bound, ApartMapFor::kMeasuring, poll, options.coarser);
    };
    std::optional<ApartMap> apart;
    if (options.start && !IsLargeChart(mesh)) apart = from(*options.start);
    if (!apart) apart = from(flat.uv);
    if (!apart) return false;
    flat.uv = std::move(apart->uv);
    flat.l2_stretch = apart->l2_stretch;
    return true;
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
  const SeamMask no_seams_;
  const double unit_;
  MapPricing<MeshType> pricing_;
};

}  // namespace dcharts
