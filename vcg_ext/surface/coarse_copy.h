// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <mutex>
#include <vector>

#include "surface/chart_patch.h"
#include "surface/charts.h"
#include "surface/coarsen.h"

namespace dcharts {

/// A coarse copy of a surface with charts, to take patches of several charts from.
class CoarseCopy {
 public:
  /// See CoarsenCharts. Every face must have a chart.
  template <class MeshType>
  CoarseCopy(const SurfaceGraph<MeshType>& surface, const ChartIds& ids, int target_faces,
             const std::function<void()>& poll = {})
      : coarse_(CoarsenCharts(surface, ids, target_faces, poll)),
        graph_(*coarse_.mesh),
        no_seams_(graph_.FaceCount(), 0),
        extractor_(graph_, no_seams_),
        faces_(FacesOfCharts(coarse_.ids)) {}
  CoarseCopy(const CoarseCopy&) = delete;

  const SurfaceGraph<SurfaceMesh>& Graph() const { return graph_; }
  SurfaceGraph<SurfaceMesh>& Graph() { return graph_; }
  int SourceFace(int face) const { return coarse_.source_face[face]; }  ///< of the original surface
  int Heir(int face) const { return coarse_.heir[face]; }               ///< of a face of the original surface
  const ChartIds& Ids() const { return coarse_.ids; }
  /// May be called by several threads at once.
  ChartPatch Extract(const std::vector<int>& faces) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return extractor_.Extract(faces);
  }
  const std::vector<std::vector<int>>& FacesOf() const { return faces_; }  ///< per chart

 private:
  CoarseSurface coarse_;
  SurfaceGraph<SurfaceMesh> graph_;
  SeamMask no_seams_;
  PatchExtractor<SurfaceMesh> extractor_;
  std::mutex mutex_;  // of the extractor
  std::vector<std::vector<int>> faces_;
};

}  // namespace dcharts
