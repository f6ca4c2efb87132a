// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/params.h"
#include "common/progress.h"
#include "surface/charts.h"
#include "surface/dual_distance.h"
#include "surface/growth.h"
#include "surface/seeds.h"

namespace dcharts {

/// Hole filling (Section 3.2): large holes get charts of their own, recursively; small ones are grown over by
/// the charts around them without a bound on the fitting error.
template <class MeshType>
class HoleFiller {
 public:
  HoleFiller(const SurfaceGraph<MeshType>& surface, const Params& params, Progress& progress)
      : surface_(surface),
        params_(params),
        progress_(progress),
        seeds_(surface),
        growth_(surface, params, [&progress] { progress.Poll(); }) {}

  /// Leaves no face unassigned.
  void Run(ChartIds& ids) {
    FillLarge(ids);
    progress_.Update(0.5);
    FillSmall(ids);
    FillIsolated(ids);
    SplitAndCompact(surface_, ids);
  }

 private:
  struct Hole {
    std::vector<int> faces;
    int depth;  // of the recursion
  };

  void FillLarge(ChartIds& ids) {
    const double small_area = params_.small_hole_percent / 100 * surface_.TotalArea();
    int next_id = ChartCount(ids);
    std::vector<Hole> holes = Holes(ids, AllFaces(), 0);
    while (!holes.empty()) {
      const Hole hole = std::move(holes.back());
      holes.pop_back();
      if (AreaOf(hole.faces) <= small_area) continue;
      progress_.Poll();
      const GrowingChart chart = seeds_.Refit(hole.faces, params_);
      // Where even a chart made for the place hardly fits (noise), a bound would split it forever.
      constexpr int kDeepest = 12;
      const double bound = hole.depth < kDeepest ? params_.max_fitting_error : Growth<MeshType>::kNoBound;
      growth_.FromSeeds({chart}, next_id++, bound, ids);
      for (Hole& rest : Holes(ids, hole.faces, hole.depth + 1)) holes.push_back(std::move(rest));
    }
  }

  void FillSmall(ChartIds& ids) {
    const auto faces = FacesOfCharts(ids);
    std::vector<GrowingChart> charts;
    std::vector<double> distance(surface_.FaceCount(), 0);
    DualDistance<MeshType> from_seed(surface_);
    for (int c = 0; c < static_cast<int>(faces.size()); ++c) {
      GrowingChart chart;
      if (!faces[c].empty()) {
        chart = seeds_.Refit(faces[c], params_);
        from_seed.Run({chart.seed}, [&](int f) { return ids[f] == c; });
        // A painted chart may be in several pieces: those the seed doesn't reach count from their own place.
        for (int f : faces[c]) distance[f] = std::isfinite(from_seed[f]) ? from_seed[f] : 0;
      }
      charts.push_back(chart);
    }
    growth_.IntoHoles(charts, Growth<MeshType>::kNoBound, distance, ids);
  }

  // Small components of the mesh that no chart touches.
  void FillIsolated(ChartIds& ids) const {
    int next_id = ChartCount(ids);
    for (const Hole& hole : Holes(ids, AllFaces(), 0)) {
      for (int f : hole.faces) ids[f] = next_id;
      ++next_id;
    }
  }

  // Connected components of the unassigned among `faces`.
  std::vector<Hole> Holes(const ChartIds& ids, const std::vector<int>& faces, int depth) const {
    std::vector<Hole> holes;
    visited_.resize(surface_.FaceCount(), 0);
    ++visit_;
    for (int start : faces) {
      if (ids[start] != kUnassigned || visited_[start] == visit_) continue;
      Hole hole{{start}, depth};
      visited_[start] = visit_;
      for (size_t k = 0; k < hole.faces.size(); ++k)
        for (int i = 0; i < 3; ++i) {
          const int g = surface_.Neighbour(3 * hole.faces[k] + i);
          if (g < 0 || ids[g] != kUnassigned || visited_[g] == visit_) continue;
          visited_[g] = visit_;
          hole.faces.push_back(g);
        }
      holes.push_back(std::move(hole));
    }
    return holes;
  }

  std::vector<int> AllFaces() const {
    std::vector<int> faces(surface_.FaceCount());
    for (int f = 0; f < surface_.FaceCount(); ++f) faces[f] = f;
    return faces;
  }

  double AreaOf(const std::vector<int>& faces) const {
    double area = 0;
    for (int f : faces) area += surface_.Area(f);
    return area;
  }

  const SurfaceGraph<MeshType>& surface_;
  const Params& params_;
  Progress& progress_;
  Seeds<MeshType> seeds_;
  Growth<MeshType> growth_;
  mutable std::vector<int> visited_;
  mutable int visit_ = 0;
};

}  // namespace dcharts
