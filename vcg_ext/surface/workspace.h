// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/params.h"
#include "common/progress.h"
#include "common/surface_data.h"
#include "surface/charts.h"
#include "surface/seams.h"
#include "surface/surface_graph.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// A host's mesh made ready for the stages, and the way back: chart ids and texcoords for each of the host's
/// faces.
class Workspace {
 public:
  /// Throws Error for a mesh that is refused, see BuildSurface. `data` must outlive the workspace.
  explicit Workspace(const SurfaceData& data);

  const SurfaceGraph<SurfaceMesh>& Surface() const { return surface_; }
  /// Per face of the surface: its index in the host's mesh. Vertices have the host's numbers.
  const std::vector<int>& SourceFaces() const { return built_.source_face; }

  /// The charts that stand in face quality (ChartIdOfQuality), one per connected piece; all faces alike (or
  /// none with quality) are one chart.
  ChartIds ReadCharts() const;

  /// The same with every face in a chart: where some had none, Fill's defaults are used and the log says so.
  ChartIds ReadFilledCharts(Progress& progress) const;

  bool HasTexcoords() const;  ///< there are some, and they are not all one point
  WedgeTexcoords ReadTexcoords() const;

  /// Seams from the host's attribute if it agrees with `ids`, else from texcoords that do. False when neither
  /// does.
  bool ReadSeams(const ChartIds& ids, SeamMask& seams) const;

  /// Per face the mean quality of its vertices; empty, and logged, when there is none above 0.
  std::vector<double> ReadDensity(Progress& progress) const;

  void WriteCharts(const ChartIds& ids, SurfaceChange& change) const;  ///< ids and colours
  void WriteSeams(const SeamMask& seams, SurfaceChange& change) const;
  void WriteTexcoords(const WedgeTexcoords& uv, SurfaceChange& change) const;
  void WriteSeamLines(const SeamMask& seams, SurfaceChange& change) const;

  /// Edges over which texcoords or the texture index jump.
  SeamMask TextureSeams() const;

 private:
  const SurfaceData& data_;
  SurfaceMesh mesh_;
  BuiltSurface built_;
  SurfaceGraph<SurfaceMesh> surface_;
};

}  // namespace dcharts
