// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/params.h"
#include "common/progress.h"
#include "planar/cone_proxy.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/darts.h"
#include "surface/known_flattenings.h"
#include "surface/open_chart.h"
#include "surface/patch_paths.h"
#include "surface/seams.h"
#include "surface/split_chart.h"
#include "surface/stretch_darts.h"

namespace dcharts {

/// Cuts inside charts (Section 3.3, "Darts and gussets"). Seams only ever get more.
template <class MeshType>
class ChartCutter {
 public:
  ChartCutter(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface), params_(params), progress_(progress) {}

  /// All cuts: handles, loops, darts. `seams` is set anew. `ids` change where a chart falls apart along its
  /// cuts, and where one had to be parted to keep within params.max_stretch. Returns the number of darts.
  /// Flattenings that were made on the way are left in `known`, where Merge may have left what it found.
  int Run(ChartIds& ids, SeamMask& seams, KnownFlattenings& known) {
    seams = ChartBorders(surface_, ids);
    OpenHandles(ids, seams);
    progress_.Update(0.3);
    JoinLoops(ids, seams);
    progress_.Update(0.6);
    const bool by_stretch = params_.dart_by == DartMethod::kMeasuredStretch;
    int darts = by_stretch ? 0 : CutByFittingError(ids, seams);
    if (by_stretch || MayPart()) darts += CutByStretch(ids, seams, known);
    DropIneffectiveSeams(surface_, seams);
    return darts;
  }

  /// How near charts come to their bound is a matter of chance. Where the mean L2 stretch of the whole is
  /// above halfway to it, the charts that are stretched most get more darts, until it no longer is or none
  /// helps. Nothing where darts don't go by stretch, or a number of charts is asked for. `known`: of Run().
  /// Returns the number of darts.
  int LowerMeanStretch(const ChartIds& ids, SeamMask& seams, KnownFlattenings& known) {
    if (params_.dart_by != DartMethod::kMeasuredStretch || !MayPart()) return 0;
    const double halfway = 1 + (params_.StretchBound() - 1) / 2;
    std::vector<std::pair<double, std::vector<int>>> charts;  // L2 stretch, faces
    double excess = 0;  // of the mean stretch over `halfway`, times the area
    PatchExtractor<MeshType> extractor(surface_, seams);
    for (std::vector<int>& faces : FacesOfCharts(ids)) {
      progress_.Poll();
      const ChartPatch patch = extractor.Extract(faces);
      const Flattening* flat = known.Find(patch);
      if (!flat) return 0;  // it could not be laid flat
      excess += patch.Area() * (flat->l2_stretch - halfway);
      if (flat->l2_stretch > halfway) charts.push_back({flat->l2_stretch, std::move(faces)});
    }
    std::stable_sort(charts.begin(), charts.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    constexpr int kMostFailures = 12;
    int count = 0, failures = 0;
    for (size_t k = 0; k < charts.size() && excess > 0 && failures < kMostFailures; ++k) {
      progress_.Poll();
      const auto& [before, faces] = charts[k];
      const ChartPatch patch = extractor.Extract(faces);
      DartGoal goal = GoalOf(patch, halfway);
      goal.may_give_up = false;
      DartedChart darted = CutStretchDarts(
          patch, goal, [this] { progress_.Poll(); }, known.Of(patch, goal));
      if (!darted.flat.ok || darted.count == 0 || darted.flat.l2_stretch >= before) {
        ++failures;
        continue;
      }
      excess += patch.Area() * (darted.flat.l2_stretch - before);
      count += darted.count;
      Mark(darted.patch, darted.edges, seams);
      known.Add(darted.patch, std::move(darted.flat), std::move(darted.coarser));
    }
    return count;
  }

  /// The cuts that no chart can do without: after it every chart has a boundary and no handle. Returns how
  /// many charts it had to cut.
  int OpenHandles(ChartIds& ids, SeamMask& seams) {
    int opened = 0;
    // A cut along a chart's own boundary may part it; then its pieces are looked at again.
    for (bool changed = true; changed;) {
      changed = false;
      ForEachChart(ids, seams, [&](const ChartPatch& patch) {
        const std::vector<int> cuts = CutsThatOpenHandles(patch);
        Mark(patch, cuts, seams);
        opened += !cuts.empty();
        changed |= !cuts.empty();
      });
      if (changed) SplitAndCompact(surface_, ids, &seams);
    }
    return opened;
  }

  void JoinLoops(const ChartIds& ids, SeamMask& seams) {
    ForEachChart(ids, seams, [&](const ChartPatch& patch) {
      Mark(patch, CutsThatJoinLoops(patch, params_.cut_to_disk), seams);
    });
  }

  /// Makes the given cuts (local half-edges of the patch) seams.
  void Mark(const ChartPatch& patch, const std::vector<int>& edges, SeamMask& seams) const {
    for (int h : edges) {
      const int s = patch.SurfaceHalfEdge(h);
      SetSeam(seams, s);
      SetSeam(seams, surface_.Opposite(s));
    }
  }

 private:
  template <class Visit>
  void ForEachChart(const ChartIds& ids, const SeamMask& seams, const Visit& visit) {
    // Patches are taken from the state at the start: cuts of one chart don't touch another's.
    const SeamMask before = seams;
    PatchExtractor<MeshType> extractor(surface_, before);
    for (const auto& faces : FacesOfCharts(ids)) {
      progress_.Poll();
      visit(extractor.Extract(faces));
    }
  }

  // Without a number of charts to keep to, a chart above the bound on its stretch is parted.
  bool MayPart() const { return params_.max_stretch > 0 && params_.target_charts == 0; }

  // Darts where the flattened chart is stretched, if they go by that; a chart that is still above the bound
  // is parted, if it may be.
  int CutByStretch(ChartIds& ids, SeamMask& seams, KnownFlattenings& known) {
    const bool may_part = MayPart();
    const double bound = params_.StretchBound();
    int count = 0, above = 0;
    std::vector<char> done(surface_.FaceCount(), 0);
    for (bool again = true; again;) {
      again = false;
      std::vector<DartedChart> charts;
      PatchExtractor<MeshType> extractor(surface_, seams);
      for (const auto& faces : FacesOfCharts(ids))
        if (!done[faces.front()]) charts.push_back({{}, 0, {}, extractor.Extract(faces), {}, nullptr});
      ParallelForLargestFirst(
          static_cast<int>(charts.size()), progress_, [&](int k) { return charts[k].patch.faces.size(); },
          [&](int k, const std::function<void()>& poll) {
            const ChartPatch& patch = charts[k].patch;
            const DartGoal goal = GoalOf(patch, bound);
            charts[k] = CutStretchDarts(patch, goal, poll, known.Of(patch, goal));
          });
      int next_id = ChartCount(ids);
      for (DartedChart& chart : charts) {
        const std::vector<int>& faces = chart.patch.faces;
        for (int f : faces) done[f] = 1;
        const bool good = chart.flat.ok && chart.flat.l2_stretch <= bound;
        if (!good && JoinAllLoops(extractor.Extract(faces), seams)) {
          for (int f : faces) done[f] = 0;
          again = true;
          continue;
        }
        if (!good && may_part && faces.size() > 1) {
          const ChartPatch whole = extractor.Extract(faces);
          PartChart(whole, Bisect(whole, [this] { progress_.Poll(); }), next_id++, ids, seams);
          for (int f : faces) done[f] = 0;
          again = true;
          continue;
        }
        above += !good;
        count += chart.count;
        Mark(chart.patch, chart.edges, seams);
        if (chart.flat.ok) known.Add(chart.patch, std::move(chart.flat), std::move(chart.coarser));
      }
      if (again) {
        SplitAndCompact(surface_, ids, &seams);
        JoinLoops(ids, seams);
      }
    }
    if (above > 0 && params_.target_charts > 0)
      progress_.Log(std::to_string(above) +
                    " charts exceed max_stretch: the number of charts asked for goes before it.");
    return count;
  }

  // A loop that was left uncut may be why a chart is stretched. False when all are joined already.
  bool JoinAllLoops(const ChartPatch& patch, SeamMask& seams) const {
    const std::vector<int> cuts = CutsThatJoinLoops(patch, true);
    Mark(patch, cuts, seams);
    return !cuts.empty();
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

  int CutByFittingError(const ChartIds& ids, SeamMask& seams) {
    int count = 0;
    ForEachChart(ids, seams, [&](const ChartPatch& patch) {
      NormalMoments moments;
      for (int f : patch.faces) moments.Add(surface_.Area(f), surface_.Normal(f));
      const ConeProxy proxy = FitCone(moments);
      std::vector<double> error;
      for (int f : patch.faces) error.push_back(FittingError(proxy, surface_.Normal(f)));
      const Darts darts = PlanDarts(patch, error, params_);
      Mark(patch, darts.edges, seams);
      count += darts.count;
    });
    return count;
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
};

}  // namespace dcharts
