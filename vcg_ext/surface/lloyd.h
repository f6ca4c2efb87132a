// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
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
      : surface_(surface), params_(params), progress_(progress), seeds_(surface), growth_(surface, params) {}

  /// params.chart_count charts; 0 finds the number: the smallest of a growing list for which hardly any face
  /// stays unassigned and the charts fit well.
  Segmentation Run() {
    if (params_.chart_count > 0) return Iterate(params_.chart_count, params_.max_iterations);
    // What a proxy explains to this mean error flattens with little stretch; found on models of many kinds.
    const double good_energy = kGoodEnergy * params_.max_fitting_error;
    const double good_unassigned = params_.small_hole_percent / 100;
    constexpr int kTrialIterations = 12;
    int iterations = 0;
    for (int count = 1;; count = std::max(count + 1, count * 5 / 4)) {
      Segmentation trial = Iterate(count, std::min(kTrialIterations, params_.max_iterations));
      iterations += trial.iterations;
      const bool good = trial.energy <= good_energy && trial.unassigned_area <= good_unassigned;
      if (!good && count < std::min(kMostCharts, surface_.FaceCount())) continue;
      trial = Iterate(count, params_.max_iterations);
      trial.iterations += iterations;
      return trial;
    }
  }

 private:
  static constexpr double kGoodEnergy = 0.04;
  static constexpr int kMostCharts = 2000;

  Segmentation Iterate(int count, int max_iterations) {
    std::vector<GrowingChart> charts = seeds_.FarthestPoints(count);
    Segmentation best;
    ChartIds ids, previous;
    for (int iteration = 1; iteration <= max_iterations; ++iteration) {
      progress_.Update(iteration / (iteration + 5.0));
      ids.assign(surface_.FaceCount(), kUnassigned);
      growth_.FromSeeds(charts, params_.max_fitting_error, ids);
      Keep(ids, charts, best);
      best.iterations = iteration;
      if (iteration > 1 && Reassigned(previous, ids) < params_.reassigned_percent / 100) break;
      previous = ids;

      std::vector<GrowingChart> next;
      for (const auto& faces : FacesOfCharts(ids))
        if (!faces.empty()) next.push_back(seeds_.Refit(faces, params_));
      charts = std::move(next);
    }
    RemoveSpecks(best.ids);
    return best;
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

  static double Reassigned(const ChartIds& before, const ChartIds& now) {
    size_t count = 0;
    for (size_t f = 0; f < now.size(); ++f) count += before[f] != now[f];
    return static_cast<double>(count) / static_cast<double>(now.size());
  }

  // A chart of a face or two could not grow: its place is a hole for Fill.
  void RemoveSpecks(ChartIds& ids) const {
    constexpr size_t kSpeck = 3;
    if (ids.size() < 10 * kSpeck) return;
    for (const auto& faces : FacesOfCharts(ids))
      if (faces.size() < kSpeck)
        for (int f : faces) ids[f] = kUnassigned;
    SplitAndCompact(surface_, ids);
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
  Seeds<MeshType> seeds_;
  Growth<MeshType> growth_;
};

}  // namespace dcharts
