// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
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
  /// Throws Error for a mesh that is refused, see BuildSurface. `data` must outlive the workspace. `poll` is
  /// called now and then and may throw.
  explicit Workspace(
      const SurfaceData& data, const std::function<void()>& poll = [] {});

  const SurfaceGraph<SurfaceMesh>& Surface() const { return surface_; }
  /// Per face of the surface: its index in the host's mesh. Vertices have the host's numbers.
  const std::vector<int>& SourceFaces() const { return built_.source_face; }

  /// Makes the texture borders and creases that params.keep_seams and params.crease_angle name borders of the
  /// surface, so that no chart goes across, until ReleaseBorders.
  void KeepBorders(const Params& params, Progress& progress);
  /// The same borders as in another workspace of the same faces.
  void KeepBordersOf(const Workspace& other) { surface_.Part(other.KeptBorders()); }
  /// The kept borders are edges as all others again...
  void ReleaseBorders() { surface_.RejoinParted(); }
  /// ...and seams, but for those that open nothing.
  void ReleaseBorders(SeamMask& seams);

  /// The charts that stand in face quality (ChartIdOfQuality), one per connected piece; all faces alike (or
  /// none with quality) are one chart.
  ChartIds ReadCharts() const;

  /// The same with every face in a chart: where some had none, Fill's defaults are used and the log says so.
  ChartIds ReadFilledCharts(Progress& progress) const;

  bool HasTexcoords() const;  ///< there are some, and they are not all one point
  /// Says that texcoords are about to be lost, if there are any but those that Cut left.
  void WarnOfReplacedTexcoords(Progress& progress) const;
  WedgeTexcoords ReadTexcoords() const;

  /// Seams from the host's attribute if it agrees with `ids`, else from texcoords that do. False when neither
  /// does. Kept borders that the attribute knows of become such again, and are not among the seams.
  bool ReadSeams(const ChartIds& ids, SeamMask& seams);

  /// Per face the mean quality of its vertices; empty, and logged, when there is none above 0.
  std::vector<double> ReadDensity(Progress& progress) const;

  void WriteCharts(const ChartIds& ids, SurfaceChange& change) const;  ///< ids and colours
  void WriteSeams(const SeamMask& seams, const SeamMask& kept, SurfaceChange& change) const;
  void WriteTexcoords(const WedgeTexcoords& uv, SurfaceChange& change) const;
  void WriteSeamLines(const SeamMask& seams, SurfaceChange& change) const;

  /// Edges over which texcoords or the texture index jump.
  SeamMask TextureSeams() const;
  SeamMask KeptBorders() const;  ///< on both sides

 private:
  const SurfaceData& data_;
  SurfaceMesh mesh_;
  BuiltSurface built_;
  SurfaceGraph<SurfaceMesh> surface_;
};

}  // namespace dcharts
