// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/params.h"
#include "common/progress.h"
#include "common/threads.h"
#include "surface/charts.h"
#include "surface/growth.h"
#include "surface/lloyd_iterations.h"
#include "surface/seeds.h"

namespace dcharts {

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
    Iterations run(surface_, seeds_, params_, std::move(charts));
    return Iterate(run, std::min(kFewIterations, params_.max_iterations));
  }

  /// The charts of a segmentation, with its own proxies and seeds.
  std::vector<GrowingChart> ChartsOf(const ChartIds& ids) const {
    return RefittedCharts(seeds_, ids, params_);
  }

 private:
  using Iterations = LloydIterations<MeshType>;
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
    constexpr size_t kStride = 4;
    const int most = std::min(kMostCharts, surface_.FaceCount());
    std::vector<int> counts;
    for (int count = 1; counts.empty() || counts.back() < most; count = std::max(count + 1, count * 5 / 4))
      counts.push_back(std::min(count, most));
    const auto after = [&](size_t i) { return std::min(i + kStride, counts.size() - 1); };
    const auto is_good = [&](size_t i, const Guess& guess) {
      if (i + 1 == counts.size()) return true;  // there are no more
      return FitWell(counts[i], guess);
    };
    size_t low = 0, high = std::min(2 * kStride, counts.size()) - 1;
    while (!is_good(high, {counts[after(high)], TrialIterations()})) {
      low = high + 1;
      high = after(high);
    }
    while (low < high) {
      const size_t middle = (low + high) / 2;
      if (is_good(middle, {counts[high], params_.max_iterations}))
        high = middle;
      else
        low = middle + 1;
    }
    Segmentation result = Iterate(counts[low], params_.max_iterations);
    asked_[counts[low]] = result.iterations;
    result.iterations = 0;
    for (const auto& [count, iterations] : asked_) result.iterations += iterations;
    return result;
  }

  Segmentation Iterate(int count, int max_iterations) { return Iterate(RunOf(count), max_iterations); }

  Iterations& RunOf(int count) {
    const auto known = runs_.find(count);
    if (known != runs_.end()) return known->second;
    return runs_.try_emplace(count, surface_, seeds_, params_, seeds_.FarthestPoints(count)).first->second;
  }

  int TrialIterations() const {
    constexpr int kTrialIterations = 6;
    return std::min(kTrialIterations, params_.max_iterations);
  }

  // What may be asked for next: so many iterations of so many charts.
  struct Guess {
    int count, iterations;
  };

  // Whether so many charts fit well. On a large surface a thread without work goes on with the guess
  // meanwhile.
  bool FitWell(int count, const Guess& guess) {
    constexpr int kManyFaces = 45000;
    Iterations& run = RunOf(count);
    if (surface_.FaceCount() < kManyFaces || FreeThreads() == 0 || guess.count == count) {
      return FitsWell(run, asked_[count], [&] { MakeOne(run); });
    }
    Iterations& next = RunOf(guess.count);
    int& asked = asked_[count];
    std::atomic<bool> told{false};
    bool fits = false;
    InParallel(
        2, [this] { progress_.Poll(); },
        [&](int k, const std::function<void()>& poll) {
          Growth<MeshType> growth(surface_, params_, poll);
          if (k == 0) {
            fits = FitsWell(run, asked, [&] { run.MakeOne(growth); });
            told = true;
          } else {
            while (!told && next.Made() < guess.iterations && !next.AreDone()) next.MakeOne(growth);
          }
        });
    return fits;
  }

  // Makes no more iterations than it takes to tell, but for those that are there already; `asked` counts what
  // it takes. Those after the third have lowered the energy by less than half, on all models tried.
  template <class Make>
  bool FitsWell(const Iterations& run, int& asked, const Make& make_one) const {
    constexpr int kTelling = 3;
    constexpr double kHopeless = 2;
    const double good = GoodEnergy();
    for (int iteration = 1; iteration <= TrialIterations(); ++iteration) {
      if (run.Made() < iteration && !run.AreDone()) make_one();
      asked = std::min(iteration, run.Made());
      if (run.Energy(iteration) <= good) return true;
      if (iteration >= kTelling && run.Energy(iteration) > kHopeless * good) return false;
    }
    return false;
  }

  void MakeOne(Iterations& run) {
    progress_.Update((run.Made() + 1) / (run.Made() + 6.0));
    run.MakeOne(growth_);
  }

  Segmentation Iterate(Iterations& run, int max_iterations) {
    while (run.Made() < max_iterations && !run.AreDone()) MakeOne(run);
    Segmentation result = run.Best();
    RemoveSpecks(result.ids);
    return result;
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
  std::map<int, int> asked_;        // how many iterations of these were not only guesses
};

}  // namespace dcharts
