// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "common/params.h"
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

/// The charts of a segmentation, with their own proxies and seeds.
template <class MeshType>
std::vector<GrowingChart> RefittedCharts(const Seeds<MeshType>& seeds, const ChartIds& ids,
                                         const Params& params) {
  std::vector<GrowingChart> charts;
  for (const auto& faces : FacesOfCharts(ids))
    if (!faces.empty()) charts.push_back(seeds.Refit(faces, params));
  return charts;
}

/// Lloyd iterations from some charts, each of which grows them anew from the seeds and proxies of the last.
/// Several of one surface may go on at the same time.
template <class MeshType>
class LloydIterations {
 public:
  /// All must outlive this object.
  LloydIterations(const SurfaceGraph<MeshType>& surface, const Seeds<MeshType>& seeds, const Params& params,
                  std::vector<GrowingChart> charts)
      : surface_(surface), seeds_(seeds), params_(params), charts_(std::move(charts)) {}

  int Made() const { return static_cast<int>(energies_.size()); }
  /// More would change little.
  bool AreDone() const { return done_; }
  /// What the best of the first `count` has, or of all if that are fewer.
  double Energy(int count) const { return energies_[static_cast<std::size_t>(std::min(count, Made()) - 1)]; }
  const Segmentation& Best() const { return best_; }

  void MakeOne(Growth<MeshType>& growth) {
    // The iterations may swing without end: they stop when nothing was gained for a while.
    constexpr int kPatience = 6;
    constexpr double kGain = 0.005;
    ChartIds ids(surface_.FaceCount(), kUnassigned);
    growth.FromSeeds(charts_, params_.max_fitting_error, ids);
    Keep(ids);
    energies_.push_back(best_.energy);
    best_.iterations = Made();
    const bool gained = best_.energy < (1 - kGain) * gained_from_;
    if (gained) gained_from_ = best_.energy;
    without_gain_ = gained ? 0 : without_gain_ + 1;
    done_ = (Made() > 1 && Reassigned(previous_, ids) < params_.reassigned_percent / 100) ||
            without_gain_ >= kPatience;
    if (!done_) charts_ = RefittedCharts(seeds_, ids, params_);
    previous_.swap(ids);
  }

 private:
  // The iterations may swing: the best one counts.
  void Keep(const ChartIds& ids) {
    double error = 0, unassigned = 0;
    for (int f = 0; f < surface_.FaceCount(); ++f) {
      if (ids[f] == kUnassigned)
        unassigned += surface_.Area(f);
      else
        error += surface_.Area(f) * FittingError(charts_[ids[f]].proxy, surface_.Normal(f));
    }
    const double energy = (error + params_.max_fitting_error * unassigned) / surface_.TotalArea();
    if (!best_.ids.empty() && energy >= best_.energy) return;
    best_.ids = ids;
    best_.energy = energy;
    best_.unassigned_area = unassigned / surface_.TotalArea();
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

  const SurfaceGraph<MeshType>& surface_;
  const Seeds<MeshType>& seeds_;
  const Params& params_;
  std::vector<GrowingChart> charts_;
  Segmentation best_;
  std::vector<double> energies_;  // of the best after each
  ChartIds previous_;
  double gained_from_ = std::numeric_limits<double>::infinity();
  int without_gain_ = 0;
  bool done_ = false;
};

}  // namespace dcharts
