// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "common/params.h"
#include "common/progress.h"
#include "common/surface_data.h"
#include "pattern/equal_seams.h"
#include "pattern/flat_charts.h"
#include "pattern/surface/chart_images.h"
#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/known_flattenings.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// Charts that are mirror images of others may exceed the bound on stretch by as much.
constexpr double kImagesStretch = 1.5;

/// Lays charts flat for a pattern (Section 4): overlaps are cut off, darts that are not needed are shortened.
class ChartsForPattern {
 public:
  /// `to_mm`: millimetres of the finished object per unit of the surface; All
  /// must outlive this.
  ChartsForPattern(const SurfaceGraph<SurfaceMesh>& surface, const Params& params, double to_mm,
                   const MirroredHalves& halves, Progress& progress)
      : surface_(surface), params_(params), to_mm_(to_mm), progress_(progress), images_(halves) {}

  /// `ids` and `seams` change where a chart had to be cut or split, and where a dart is shortened.
  void Flatten(ChartIds& ids, SeamMask& seams, const KnownFlattenings& known);

  /// Sews up each dart from its tip as far as its legs lie side by side in the plane. Returns how many darts
  /// became shorter; Flatten does so for fabric.
  int ShortenDarts(const ChartIds& ids, SeamMask& seams);

  /// Joins charts too small to sew or to glue to a neighbour, where both lie flat together. Returns how many
  /// it joined.
  int JoinSmallCharts(ChartIds& ids, SeamMask& seams);

  /// Gives both sides of every seam the same length. A chart whose outline would cross itself then has its
  /// darts sewn up that cross, or is parted; so is one that leaves no room for its allowance, or loses or
  /// gains area though it is of paper. Returns how many charts were left with seams of unequal length.
  int EqualizeAllSeams(ChartIds& ids, SeamMask& seams);

  /// The flat charts in mm, at their places on the finished object. `data`, `source_face`: the mesh that the
  /// surface was made of, and per face of the surface its own there.
  FlatCharts Take(const ChartIds& ids, const SeamMask& seams, const SurfaceData& data, double data_to_mm,
                  const std::vector<int>& source_face) const;

 private:
  struct Finished {
    ChartPatch patch{};
    FlatChart chart{};
    std::vector<int> boundary{};
    EqualSeams seams{};
  };

  void LayFlat(ChartIds& ids, SeamMask& seams, const KnownFlattenings& known);
  FlatChart ChartOf(const ChartPatch& patch) const;
  void Finish(Finished& chart, const std::function<void()>& poll) const;
  std::optional<std::pair<int, int>> MeetsItself(const Finished& chart) const;
  bool IsOffInArea(const Finished& chart) const;
  double UselessArea() const;  // a smaller piece can't be sewn or folded
  bool TryJoin(int small, int other, ChartIds& ids, SeamMask& seams);
  int JoinWithImages(int small, int other, ChartIds& ids, SeamMask& seams);
  // Of a chart that is its own image, takes away the half-edges whose images aren't among them.
  void KeepImages(int face, std::vector<int>& edges) const;
  bool SewUpCrossingDarts(const Finished& chart, SeamMask& seams);
  Points2 StoredUv(const ChartPatch& patch) const;
  void Store(const ChartPatch& patch, const Points2& uv);

  const SurfaceGraph<SurfaceMesh>& surface_;
  const Params& params_;
  double to_mm_;
  Progress& progress_;
  ChartImages images_;
  std::vector<FaceUv> wedge_;  // per face, at the surface's scale
};

}  // namespace dcharts
