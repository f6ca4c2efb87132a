// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "common/params.h"
#include "common/progress.h"
#include "surface/charts.h"
#include "surface/growth.h"
#include "surface/seeds.h"

namespace dcharts {

/// The result of Segment: ids may hold unassigned faces.
struct Segmentation {
  ChartIds ids;
  int iterations = 0;
  double energy = 0;           ///< mean fitting error over the surface, unassigned faces counted with F_max
  double unassigned_area = 0;  ///< share of the surface, 0..1
};

/// Modified Lloyd iterations (Section 3.1).
template <class MeshType>
class Lloyd {
 public:
  Lloyd(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface),
        params_(params),
        progress_(progress),
        seeds_(surface),
        growth_(surface, params, [&progress] { progress.Poll(); }) {}

  /// How many charts params.target_charts are best merged from. Measured: with fewer, merging has too little
  /// choice; more cost time and gain little.
  static int EnoughCharts(const Params& params, int face_count) {
    constexpr int kEnough = 56, kPerTarget = 4;
    return std::min(std::max(kEnough, kPerTarget * std::min(params.target_charts, face_count)), face_count);
  }

  /// params.chart_count charts. 0 takes several times params.target_charts, for merging to choose from, or,
  /// without a target, finds the number: the smallest of a growing list for which the charts fit well.
  Segmentation Run() {
    if (params_.chart_count > 0) return Iterate(params_.chart_count, params_.max_iterations);
    if (params_.target_charts > 0)
      return Iterate(EnoughCharts(params_, surface_.FaceCount()), params_.max_iterations);
    return Smallest();
  }

  /// From charts that are nearly right: as few iterations as set them right.
  Segmentation RunFrom(std::vector<GrowingChart> charts) {
    constexpr int kFewIterations = 2;
    Iterations run;
    run.charts = std::move(charts);
    return Iterate(run, std::min(kFewIterations, params_.max_iterations));
  }

  /// The charts of a segmentation, with its own proxies and seeds.
  std::vector<GrowingChart> ChartsOf(const ChartIds& ids) const {
    std::vector<GrowingChart> charts;
    for (const auto& faces : FacesOfCharts(ids))
      if (!faces.empty()) charts.push_back(seeds_.Refit(faces, params_));
    return charts;
  }

 private:
  static constexpr int kMostCharts = 2000;

  // Charts that fit to this share of F_max flatten with an L2 stretch below 1.005 on models of many kinds,
  // and are about as many as the paper starts with. A tighter bound than the usual one asks for more of them.
  double GoodEnergy() const {
    constexpr double kGoodEnergy = 0.12, kUsualBound = 1.01, kLeast = 0.05;
    double share = 1;
    if (params_.max_stretch > 0)
      share = std::clamp((params_.max_stretch - 1) / (kUsualBound - 1), kLeast, 1.0);
    return share * kGoodEnergy * params_.max_fitting_error;
  }

  // Strides through the growing list of numbers, then halves the last stride: as if more charts always fitted
  // better, which is nearly so.
  Segmentation Smallest() {
    constexpr int kTrialIterations = 6;
    constexpr size_t kStride = 4;
    const int most = std::min(kMostCharts, surface_.FaceCount());
    std::vector<int> counts;
    for (int count = 1; counts.empty() || counts.back() < most; count = std::max(count + 1, count * 5 / 4))
      counts.push_back(std::min(count, most));
    const auto is_good = [&](size_t i) {
      if (i + 1 == counts.size()) return true;  // there are no more
      return FitWell(counts[i], std::min(kTrialIterations, params_.max_iterations));
    };
    size_t low = 0, high = std::min(2 * kStride, counts.size()) - 1;
    while (!is_good(high)) {
      low = high + 1;
      high = std::min(high + kStride, counts.size() - 1);
    }
    while (low < high) {
      const size_t middle = (low + high) / 2;
      if (is_good(middle))
        high = middle;
      else
        low = middle + 1;
    }
    Segmentation result = Iterate(counts[low], params_.max_iterations);
    result.iterations = 0;
    for (auto& run : runs_) result.iterations += run.second.best.iterations;
    return result;
  }

  // Iterations that can be gone on with.
  struct Iterations {
    std::vector<GrowingChart> charts;
    Segmentation best;
    ChartIds previous;
    double gained_from = std::numeric_limits<double>::infinity();
    int without_gain = 0;
    bool done = false;
  };

  Segmentation Iterate(int count, int max_iterations) { return Iterate(RunOf(count), max_iterations); }

  Iterations& RunOf(int count) {
    Iterations& run = runs_[count];
    if (run.charts.empty()) run.charts = seeds_.FarthestPoints(count);
    return run;
  }

  // Whether so many charts fit well within `max_iterations`, of which it makes no more than it takes to tell.
  // Those after the third have lowered the energy by less than half, on all models tried.
  bool FitWell(int count, int max_iterations) {
    constexpr int kTelling = 3;
    constexpr double kHopeless = 2;
    Iterations& run = RunOf(count);
    const double good = GoodEnergy();
    for (int iteration = 1; iteration <= max_iterations; ++iteration) {
      Advance(run, iteration);
      if (run.best.energy <= good) return true;
      if (iteration >= kTelling && run.best.energy > kHopeless * good) return false;
    }
    return false;
  }

  Segmentation Iterate(Iterations& run, int max_iterations) {
    Advance(run, max_iterations);
    Segmentation result = run.best;
    RemoveSpecks(result.ids);
    return result;
  }

  void Advance(Iterations& run, int max_iterations) {
    // The iterations may swing without end: they stop when nothing was gained for a while.
    constexpr int kPatience = 6;
    constexpr double kGain = 0.005;
    ChartIds ids;
    for (int iteration = run.best.iterations + 1; iteration <= max_iterations && !run.done; ++iteration) {
      progress_.Update(iteration / (iteration + 5.0));
      ids.assign(surface_.FaceCount(), kUnassigned);
      growth_.FromSeeds(run.charts, params_.max_fitting_error, ids);
      Keep(ids, run.charts, run.best);
      run.best.iterations = iteration;
      const bool gained = run.best.energy < (1 - kGain) * run.gained_from;
      if (gained) run.gained_from = run.best.energy;
      run.without_gain = gained ? 0 : run.without_gain + 1;
      run.done = (iteration > 1 && Reassigned(run.previous, ids) < params_.reassigned_percent / 100) ||
                 run.without_gain >= kPatience;
      if (!run.done) run.charts = ChartsOf(ids);
      run.previous.swap(ids);
    }
  }

  // The iterations may swing: the best one counts.
  void Keep(const ChartIds& ids, const std::vector<GrowingChart>& charts, Segmentation& best) const {
    double error = 0, unassigned = 0;
    for (int f = 0; f < surface_.FaceCount(); ++f) {
      if (ids[f] == kUnassigned)
        unassigned += surface_.Area(f);
      else
        error += surface_.Area(f) * FittingError(charts[ids[f]].proxy, surface_.Normal(f));
    }
    const double energy = (error + params_.max_fitting_error * unassigned) / surface_.TotalArea();
    if (!best.ids.empty() && energy >= best.energy) return;
    best.ids = ids;
    best.energy = energy;
    best.unassigned_area = unassigned / surface_.TotalArea();
  }

  // Share of the faces with a chart that have another than before.
  static double Reassigned(const ChartIds& before, const ChartIds& now) {
    size_t changed = 0, assigned = 0;
    for (size_t f = 0; f < now.size(); ++f) {
      changed += before[f] != now[f];
      assigned += now[f] != kUnassigned;
    }
    return static_cast<double>(changed) / static_cast<double>(std::max<size_t>(assigned, 1));
  }

  // A chart of a face or two could not grow: its place is a hole for Fill. Where all are so small there is no
  // other to fill it from.
  void RemoveSpecks(ChartIds& ids) const {
    constexpr size_t kSpeck = 3;
    if (ids.size() < 10 * kSpeck) return;
    const auto charts = FacesOfCharts(ids);
    const auto is_speck = [](const std::vector<int>& faces) { return faces.size() < kSpeck; };
    if (!std::all_of(charts.begin(), charts.end(), is_speck))
      for (const auto& faces : charts)
        if (is_speck(faces))
          for (int f : faces) ids[f] = kUnassigned;
    SplitAndCompact(surface_, ids);
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
  Seeds<MeshType> seeds_;
  Growth<MeshType> growth_;
  std::map<int, Iterations> runs_;  // from so many of the farthest points
};

}  // namespace dcharts
