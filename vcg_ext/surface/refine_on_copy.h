// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "common/params.h"
#include "common/progress.h"
#include "surface/border_graph_cut.h"
#include "surface/charts.h"
#include "surface/coarse_copy.h"
#include "surface/refine_borders.h"

namespace dcharts {

/// A Pricing for BorderGraphCut: only the length of borders counts.
struct LengthPricing {
  static double Reach() { return 0; }
  void Prepare(int, int, const std::vector<int>&, const std::vector<int>&, const ChartIds&) {}
  double operator()(int) const { return 0; }
};

/// Of each chart only its largest piece stays; the others go to the neighbour with the longest common border.
template <class MeshType>
void AbsorbIslands(const SurfaceGraph<MeshType>& surface, ChartIds& ids) {
  constexpr int kRounds = 10;  // an island in an island goes with it, or comes later
  for (int round = 0; round < kRounds; ++round) {
    ChartIds pieces = ids;
    SplitAndCompact(surface, pieces);
    const int piece_count = ChartCount(pieces), chart_count = ChartCount(ids);
    if (piece_count == chart_count) return;
    std::vector<double> area(piece_count, 0);
    std::vector<int> chart(piece_count), largest(chart_count, -1), home(piece_count, -1);
    for (int f = 0; f < surface.FaceCount(); ++f) {
      area[pieces[f]] += surface.Area(f);
      chart[pieces[f]] = ids[f];
    }
    for (int p = 0; p < piece_count; ++p)
      if (int& best = largest[chart[p]]; best < 0 || area[p] > area[best]) best = p;
    std::vector<std::map<int, double>> borders(piece_count);  // of islands, with charts
    for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
      const int g = surface.Neighbour(h), p = pieces[h / 3];
      if (g >= 0 && pieces[g] != p && largest[chart[p]] != p) borders[p][ids[g]] += surface.Length(h);
    }
    bool any = false;
    for (int p = 0; p < piece_count; ++p) {
      double longest = -1;
      for (const auto& [c, length] : borders[p])
        if (length > longest) {
          longest = length;
          home[p] = c;
        }
      any |= home[p] >= 0;
    }
    if (!any) return;
    for (int f = 0; f < surface.FaceCount(); ++f)
      if (home[pieces[f]] >= 0) ids[f] = home[pieces[f]];
  }
}

/// BorderRefiner for a large surface: borders are moved on a coarser copy of it, `copy`, made with charts
/// that those of `ids` are put together from. On the surface they are then straightened where they came to
/// lie. `known`: trials on the copy.
template <class MeshType>
void RefineBordersOnCopy(const SurfaceGraph<MeshType>& surface, const CoarseCopy& copy,
                         const KnownTrials& known, const Params& params, Progress& progress, ChartIds& ids) {
  const int copy_faces = copy.Graph().FaceCount();
  ChartIds before(copy_faces);
  for (int f = 0; f < copy_faces; ++f) before[f] = ids[copy.SourceFace(f)];
  ChartIds after = before;
  BorderRefiner<SurfaceMesh>(copy.Graph(), params, progress).Run(known, after);
  if (after == before) return;
  for (int f = 0; f < surface.FaceCount(); ++f) {
    const int heir = copy.Heir(f);
    if (after[heir] != before[heir]) ids[f] = after[heir];
  }
  AbsorbIslands(surface, ids);
  BorderCutOptions options;
  constexpr double kEdges = 3;  // of the copy: how far a border is from where it was there
  options.band = kEdges * std::sqrt(2.3 / copy_faces);
  options.max_sweeps = 1;
  LengthPricing pricing;
  BorderGraphCut<MeshType, LengthPricing>(surface, options, pricing, progress).Run(ids);
}

}  // namespace dcharts
