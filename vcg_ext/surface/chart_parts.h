// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/coarsen.h"

namespace dcharts {

/// The charts that merging starts from, as parts that larger charts are put together from: their faces on the
/// surface and on a coarse copy of it, their areas, and the lengths of their common borders. Areas and
/// lengths are those of a surface of area 1.
template <class MeshType>
class ChartParts {
 public:
  /// Every face must have a chart. `surface` must outlive the parts.
  ChartParts(const SurfaceGraph<MeshType>& surface, const ChartIds& ids)
      : part_(ids),
        fine_faces_(FacesOfCharts(ids)),
        area_(fine_faces_.size(), 0),
        borders_(fine_faces_.size()),
        unit_(std::sqrt(surface.TotalArea())),
        no_seams_(surface.FaceCount(), 0),
        fine_(surface, no_seams_),
        coarse_surface_(CoarsenCharts(surface, ids, CoarseFaces())),
        coarse_graph_(*coarse_surface_.mesh),
        coarse_(coarse_graph_, no_seams_),
        coarse_faces_(FacesOfCharts(coarse_surface_.ids)) {
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
  int PartOf(int face) const { return part_[face]; }
  int FineFaceCount() const { return static_cast<int>(part_.size()); }
  const std::vector<int>& FineFaces(int part) const { return fine_faces_[part]; }

  ChartPatch CoarsePatch(const std::vector<int>& parts) {
    return coarse_.Extract(Faces(parts, coarse_faces_));
  }
  ChartPatch FinePatch(const std::vector<int>& parts) { return fine_.Extract(Faces(parts, fine_faces_)); }

 private:
  // Enough faces to rank merges by.
  int CoarseFaces() const { return std::max(3000, 100 * Count()); }

  static std::vector<int> Faces(const std::vector<int>& parts, const std::vector<std::vector<int>>& of) {
    std::vector<int> faces;
    for (int part : parts) faces.insert(faces.end(), of[part].begin(), of[part].end());
    std::sort(faces.begin(), faces.end());
    return faces;
  }

  ChartIds part_;
  std::vector<std::vector<int>> fine_faces_;
  std::vector<double> area_;
  std::vector<std::map<int, double>> borders_;
  std::set<std::pair<int, int>> kept_apart_;
  double unit_;
  SeamMask no_seams_;
  PatchExtractor<MeshType> fine_;
  CoarseSurface coarse_surface_;
  SurfaceGraph<SurfaceMesh> coarse_graph_;
  PatchExtractor<SurfaceMesh> coarse_;
  std::vector<std::vector<int>> coarse_faces_;
};

}  // namespace dcharts
