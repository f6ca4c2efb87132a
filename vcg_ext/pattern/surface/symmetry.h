// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/progress.h"
#include "surface/charts.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// A plane that mirrors a surface onto itself, nearly.
struct MirrorPlane {
  Eigen::Vector3d normal{1, 0, 0};  ///< unit vector
  double offset = 0;                ///< of the plane along the normal
  std::vector<int> image;           ///< per face the one at its mirror image, -1 where there is none
  bool exact = false;               ///< the image of every face (a, b, c) is a face (a, c, b), exactly

  double Height(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
  Eigen::Vector3d Mirrored(const Eigen::Vector3d& p) const { return p - 2 * Height(p) * normal; }
  int ImageOfEdge(int half_edge) const {
    return 3 * image[half_edge / 3] + 2 - half_edge % 3;
  }  ///< when exact
};

/// The plane that mirrors the surface best, when it does so but for noise: nearly all of its area has a
/// mirror image within a fraction of an edge's length. The triangles need not be symmetric.
std::optional<MirrorPlane> FindMirrorPlane(const SurfaceGraph<SurfaceMesh>& surface);

/// Whether the seams are shorter in the half that the plane's normal points to.
bool HasShorterSeamsAbove(const SurfaceGraph<SurfaceMesh>& surface, const MirrorPlane& mirror,
                          const ChartIds& ids);

/// Pairs are not worth more than twice as many charts.
bool TooManyCharts(int before, int mirrored);

/// Gives one half of the surface the mirror images of the other half's charts, so that a pattern has mirrored
/// pairs. `keep_above`: the half that the normal points to is the one that stays. A chart that meets its own
/// image at the plane is joined with it where both lie flat within `stretch_bound`. Leaves `ids` alone, and
/// returns false, when there would be TooManyCharts.
bool MirrorCharts(const SurfaceGraph<SurfaceMesh>& surface, const MirrorPlane& mirror, bool keep_above,
                  double stretch_bound, Progress& progress, ChartIds& ids);

/// Cuts within charts of the half that stays, and their mirror images; of a surface that isn't exactly
/// symmetric only the darts. `cut_ids` and `cut_seams` have cuts, `ids` are the mirrored charts, whose
/// `seams` get them.
void MirrorCuts(const SurfaceGraph<SurfaceMesh>& surface, const MirrorPlane& mirror, bool keep_above,
                const ChartIds& cut_ids, const SeamMask& cut_seams, const ChartIds& ids, SeamMask& seams);

}  // namespace dcharts
