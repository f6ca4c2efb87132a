// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/params.h"
#include "common/progress.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/charts_for.h"
#include "surface/known_flattenings.h"
#include "surface/merge_pieces.h"
#include "surface/needed_cuts.h"
#include "surface/open_chart.h"
#include "surface/split_chart.h"
#include "surface/stretch_darts.h"

namespace dcharts {

/// Darts where flattened charts are stretched; a chart that is above params.max_stretch all the same is
/// parted, unless a number of charts is asked for.
template <class MeshType>
class StretchCutter {
 public:
  StretchCutter(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface), params_(params), progress_(progress) {}

  /// Without a number of charts to keep to, a chart above the bound on its stretch is parted.
  bool MayPart() const { return params_.max_stretch > 0 && params_.target_charts == 0; }

  /// `seams` must be those that ChartCutter makes before darts; ids and seams change. An atlas whose mean
  /// stretch is high gets more darts than its charts need. Returns the number of darts. `known`: what Merge
  /// has left there; flattenings are added.
  int Run(ChartsFor use, ChartIds& ids, SeamMask& seams, KnownFlattenings& known) {
    const bool by_stretch = params_.dart_by == DartMethod::kMeasuredStretch;
    done_.assign(surface_.FaceCount(), 0);
    is_in_piece_.assign(surface_.FaceCount(), 0);
    bool lower_mean = use == ChartsFor::kAtlas && by_stretch && MayPart();
    for (bool again = true; again; lower_mean = false) {
      CutOthers(lower_mean, known, ids, seams);
      if (MergePieces(ids, seams)) CutOthers(lower_mean, known, ids, seams);
      if (lower_mean) LowerMeanStretch();
      again = FinishAll(seams);
    }
    int count = 0, above = 0;
    for (Cut& cut : cuts_) {
      DartedChart& chart = cut.chart;
      count += chart.count;
      above += !IsGood(chart);
      MarkCuts(surface_, chart.patch, chart.edges, seams);
      if (chart.flat.ok) known.Add(chart.patch, std::move(chart.flat), std::move(chart.coarser));
    }
    if (above > 0 && params_.target_charts > 0)
      progress_.Log(std::to_string(above) +
                    " charts exceed max_stretch: the number of charts asked for goes before it.");
    return count;
  }

 private:
  struct Cut {
    DartedChart chart;
    DartGoal goal;
    std::optional<DartedChart> without;  // the darts that were added to lower the mean stretch
  };

  // All charts that are not done yet. With `mean_only`, those that need darts for the mean stretch get these
  // only.
  void CutOthers(bool mean_only, const KnownFlattenings& known, ChartIds& ids, SeamMask& seams) {
    for (bool again = true; again;) {
      again = false;
      std::vector<Cut> cuts;
      PatchExtractor<MeshType> extractor(surface_, seams);
      for (ChartPatch& patch : extractor.ExtractAll(FacesOfCharts(ids, [&](int f) { return !done_[f]; }))) {
        DartedChart chart = Uncut(std::move(patch));
        const DartGoal goal = GoalOf(chart.patch, params_.StretchBound());
        cuts.push_back({std::move(chart), goal, std::nullopt});
      }
      ParallelForLargestFirst(
          static_cast<int>(cuts.size()), progress_, [&](int k) { return cuts[k].chart.patch.faces.size(); },
          [&](int k, const std::function<void()>& poll) {
            DartedChart& chart = cuts[k].chart;
            chart = (mean_only ? CutMeanDarts : CutStretchDarts)(chart.patch, cuts[k].goal, poll,
                                                                 known.Of(chart.patch, cuts[k].goal));
          });
      int next_id = ChartCount(ids);
      for (Cut& cut : cuts) {
        const DartedChart& chart = cut.chart;
        if (!IsGood(chart) && Divide(extractor.Extract(chart.patch.faces), next_id, ids, seams)) {
          again = true;
          continue;
        }
        for (int f : chart.patch.faces) done_[f] = 1;
        MarkCuts(surface_, chart.patch, chart.edges, seams);
        cuts_.push_back(std::move(cut));
      }
      if (again) {
        SplitAndCompact(surface_, ids, &seams);
        JoinLoops(surface_, params_, progress_, ids, seams);
      }
    }
  }

  // How near charts come to their bound is a matter of chance. Where the mean L2 stretch of the whole is
  // above halfway to it, the charts that are stretched most get more darts, until it no longer is or none
  // helps.
  void LowerMeanStretch() {
    const double halfway = 1 + (params_.StretchBound() - 1) / 2;
    std::vector<std::pair<double, int>> charts;  // L2 stretch, index
    double excess = 0;                           // of the mean stretch over `halfway`, times the area
    for (int k = 0; k < static_cast<int>(cuts_.size()); ++k) {
      const DartedChart& chart = cuts_[k].chart;
      if (!chart.flat.ok) return;
      excess += chart.patch.Area() * (chart.flat.l2_stretch - halfway);
      if (chart.flat.l2_stretch > halfway) charts.push_back({chart.flat.l2_stretch, k});
    }
    std::stable_sort(charts.begin(), charts.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    constexpr int kMostFailures = 12;
    int failures = 0;
    for (size_t n = 0; n < charts.size() && excess > 0 && failures < kMostFailures;) {
      progress_.Poll();
      // A large chart takes long: others are tried ahead, unless the first one turns out to be enough.
      const bool is_large = IsLargeChart(cuts_[charts[n].second].chart.patch.mesh);
      const size_t ahead = is_large ? static_cast<size_t>(FreeThreads()) : 0;
      std::vector<std::optional<Cut>> lower(std::min(1 + ahead, charts.size() - n));
      FirstThat(
          static_cast<int>(lower.size()), [this] { progress_.Poll(); },
          [&](int k, const std::function<void()>& poll) {
            const Cut& cut = cuts_[charts[n + k].second];
            lower[k] = WithMeanDarts(cut, halfway, poll);
            return k == 0 && lower[0] && excess + Gained(*lower[0], cut) <= 0;
          });
      for (size_t k = 0; k < lower.size() && excess > 0 && failures < kMostFailures; ++k, ++n) {
        Cut& cut = cuts_[charts[n].second];
        if (!lower[k]) {
          ++failures;
          continue;
        }
        excess += Gained(*lower[k], cut);
        lower[k]->without = std::move(cut.chart);
        cut = std::move(*lower[k]);
      }
    }
  }

  // A chart with more darts; nothing when none helps.
  std::optional<Cut> WithMeanDarts(const Cut& cut, double l2_bound, const std::function<void()>& poll) const {
    Cut lower{cut.chart, GoalOf(cut.chart.patch, l2_bound), std::nullopt};
    lower.goal.may_give_up = false;
    if (!AddMeanDarts(lower.goal, poll, lower.chart)) return std::nullopt;
    return lower;
  }

  // L2 stretch times area.
  static double Gained(const Cut& cut, const Cut& before) {
    return cut.chart.patch.Area() * (cut.chart.flat.l2_stretch - before.chart.flat.l2_stretch);
  }

  // Finishes all that are not. Those that can't be are not done then; returns whether there are such.
  bool FinishAll(SeamMask& seams) {
    std::vector<int> open;
    for (int k = 0; k < static_cast<int>(cuts_.size()); ++k)
      if (!cuts_[k].chart.finished) open.push_back(k);
    std::vector<char> failed(cuts_.size(), 0);
    ParallelForLargestFirst(
        static_cast<int>(open.size()), progress_,
        [&](int k) { return cuts_[open[k]].chart.patch.faces.size(); },
        [&](int k, const std::function<void()>& poll) { failed[open[k]] = !Finish(cuts_[open[k]], poll); });
    std::vector<Cut> finished;
    for (size_t k = 0; k < cuts_.size(); ++k) {
      if (!failed[k]) {
        finished.push_back(std::move(cuts_[k]));
        continue;
      }
      const DartedChart& chart = cuts_[k].chart;
      ClearDarts(chart, seams);
      for (int f : chart.patch.faces) done_[f] = 0;
    }
    const bool any = finished.size() < cuts_.size();
    cuts_ = std::move(finished);
    return any;
  }

  // False when it isn't within the bound then; without the last darts it was.
  bool Finish(Cut& cut, const std::function<void()>& poll) const {
    if (FinishDarts(cut.goal, poll, cut.chart) && IsGood(cut.chart)) return true;
    if (!cut.without) return false;
    cut.chart = std::move(*cut.without);
    cut.goal = GoalOf(cut.chart.patch, params_.StretchBound());
    return cut.chart.finished || (FinishDarts(cut.goal, poll, cut.chart) && IsGood(cut.chart));
  }

  bool IsGood(const DartedChart& chart) const {
    return chart.flat.ok && chart.flat.l2_stretch <= params_.StretchBound();
  }

  // Cuts or parts a chart that is stretched too much; false when that can't be or may not be.
  bool Divide(const ChartPatch& whole, int& next_id, ChartIds& ids, SeamMask& seams) {
    // A loop that was left uncut may be why it is.
    const std::vector<int> cuts = CutsThatJoinLoops(whole, true);
    MarkCuts(surface_, whole, cuts, seams);
    if (!cuts.empty()) return true;
    if (!MayPart() || whole.faces.size() == 1) return false;
    PartChart(whole, Bisect(whole, [this] { progress_.Poll(); }), next_id++, ids, seams);
    for (int f : whole.faces) is_in_piece_[f] = 1;
    return true;
  }

  // Charts that came from parting others, where they lie flat together; each is looked at once. Those that
  // did are not done then; returns whether there are such.
  bool MergePieces(ChartIds& ids, SeamMask& seams) {
    std::vector<int> pieces;
    for (int k = 0; k < static_cast<int>(cuts_.size()); ++k)
      if (is_in_piece_[cuts_[k].chart.patch.faces.front()]) pieces.push_back(k);
    std::fill(is_in_piece_.begin(), is_in_piece_.end(), 0);
    if (pieces.size() < 2) return false;
    SeamMask without_darts = seams;
    std::vector<std::vector<int>> faces;
    for (int k : pieces) {
      ClearDarts(cuts_[k].chart, without_darts);
      faces.push_back(cuts_[k].chart.patch.faces);
    }
    const std::vector<int> part_of =
        PieceMerger<MeshType>(surface_, params_.StretchBound(), std::move(without_darts), progress_)
            .Run(faces);
    std::vector<int> piece_of(surface_.FaceCount(), -1);
    for (size_t p = 0; p < pieces.size(); ++p)
      for (int f : faces[p]) piece_of[f] = static_cast<int>(p);
    std::vector<char> is_old(cuts_.size(), 0);
    for (size_t p = 0; p < pieces.size(); ++p) {
      const int whole = part_of[p];
      if (whole == static_cast<int>(p)) continue;
      for (int f : faces[p]) ids[f] = ids[faces[whole].front()];
      is_old[pieces[p]] = is_old[pieces[whole]] = 1;
    }
    std::vector<Cut> others;
    for (size_t k = 0; k < cuts_.size(); ++k) {
      if (!is_old[k]) {
        others.push_back(std::move(cuts_[k]));
        continue;
      }
      ClearDarts(cuts_[k].chart, seams);
      for (int f : cuts_[k].chart.patch.faces) {
        done_[f] = 0;
        for (int h = 3 * f; h < 3 * f + 3; ++h)
          if (const int g = surface_.Neighbour(h); g >= 0 && ids[g] == ids[f] && piece_of[g] != piece_of[f])
            ClearSeam(seams, h);
      }
    }
    const bool any = others.size() < cuts_.size();
    cuts_ = std::move(others);
    if (!any) return false;
    SplitAndCompact(surface_, ids, &seams);
    JoinLoops(surface_, params_, progress_, ids, seams);
    return true;
  }

  void ClearDarts(const DartedChart& chart, SeamMask& seams) const {
    for (int h : chart.edges) {
      const int s = chart.patch.SurfaceHalfEdge(h);
      ClearSeam(seams, s);
      ClearSeam(seams, surface_.Opposite(s));
    }
  }

  DartGoal GoalOf(const ChartPatch& patch, double bound) const {
    constexpr double kWorstStretch = 1.3;
    DartGoal goal;
    goal.l2_stretch = bound;
    goal.l2_bound = params_.StretchBound();
    goal.linf_stretch = kWorstStretch;
    if (params_.dart_by == DartMethod::kMeasuredStretch)
      goal.longest = params_.max_dart_percent / 100 * patch.Diagonal();
    goal.unit = std::sqrt(surface_.TotalArea());
    goal.may_give_up = MayPart();
    return goal;
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
  std::vector<char> done_;         // faces
  std::vector<char> is_in_piece_;  // faces of charts that were parted, until MergePieces has seen them
  std::vector<Cut> cuts_;          // all charts that are done, but perhaps for the finish
};

}  // namespace dcharts
