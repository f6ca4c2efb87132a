// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/coarse_copy.h"

namespace dcharts {

/// The charts that merging starts from, as parts that larger charts are put together from: their faces on a
/// copy of the surface for checks, on a coarser one for trials, their areas, and the lengths of their common
/// borders. Areas and lengths are those of a surface of area 1.
template <class MeshType>
class ChartParts {
 public:
  /// The most faces that checks are made on: enough to tell how flat a chart lies.
  static constexpr int kFineFaces = 75000;

  /// Every face must have a chart. `surface` must outlive the parts. `rank`: trials are to say which of many
  /// merges is best, not only which will do; that takes more faces.
  ChartParts(const SurfaceGraph<MeshType>& surface, const ChartIds& ids, bool rank,
             int fine_faces = kFineFaces, const std::function<void()>& poll = {})
      : area_(ChartCount(ids), 0),
        borders_(area_.size()),
        unit_(std::sqrt(surface.TotalArea())),
        fine_(surface, ids, fine_faces, poll),
        coarse_(fine_.Graph(), fine_.Ids(),
                std::max(kCoarseFaces, (rank ? kFacesToRank : kFacesPerPart) * Count()), poll) {
    for (int f = 0; f < surface.FaceCount(); ++f) area_[ids[f]] += surface.Area(f) / surface.TotalArea();
    for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
      const int g = surface.Neighbour(h);
      if (g >= 0 && ids[g] != ids[h / 3]) borders_[ids[h / 3]][ids[g]] += surface.Length(h) / unit_;
    }
    for (const auto& [h, o] : surface.Parted())
      if (ids[h / 3] != ids[o / 3]) kept_apart_.insert(std::minmax(ids[h / 3], ids[o / 3]));
  }

  /// Pairs of parts that have a kept border between them (SurfaceGraph::Parted), the smaller first.
  const std::set<std::pair<int, int>>& KeptApart() const { return kept_apart_; }

  int Count() const { return static_cast<int>(area_.size()); }
  double Area(int part) const { return area_[part]; }
  /// The neighbours of a part and how long the common borders are.
  const std::map<int, double>& Borders(int part) const { return borders_[part]; }
  double Unit() const { return unit_; }  ///< a length of 1 in model units

  /// Of the copy for trials.
  ChartPatch CoarsePatch(const std::vector<int>& parts) { return Patch(parts, coarse_); }
  size_t CoarseFaceCount(const std::vector<int>& parts) const {
    size_t count = 0;
    for (int part : parts) count += coarse_.FacesOf()[part].size();
    return count;
  }
  /// Of the copy for checks: the surface itself, if that isn't large.
  ChartPatch FinePatch(const std::vector<int>& parts) { return Patch(parts, fine_); }
  const CoarseCopy& Fine() const { return fine_; }
  int PartOfFine(int face) const { return fine_.Ids()[face]; }

 private:
  static constexpr int kCoarseFaces = 3000, kFacesPerPart = 50, kFacesToRank = 100;

  static ChartPatch Patch(const std::vector<int>& parts, CoarseCopy& copy) {
    std::vector<int> faces;
    for (int part : parts)
      faces.insert(faces.end(), copy.FacesOf()[part].begin(), copy.FacesOf()[part].end());
    std::sort(faces.begin(), faces.end());
    return copy.Extract(faces);
  }

  std::vector<double> area_;
  std::vector<std::map<int, double>> borders_;
  std::set<std::pair<int, int>> kept_apart_;
  double unit_;
  CoarseCopy fine_, coarse_;
};

}  // namespace dcharts
