// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "surface/charts.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// The texcoords of a face's corners: u0 v0 u1 v1 u2 v2.
using FaceUv = std::array<double, 6>;

/// Keeps charts of a symmetric mesh mirror images of each other: one of each pair is worked on, the other
/// follows it. See SymmetricMesh.
class ChartImages {
 public:
  /// `half`: of the mesh; 0 when it isn't symmetric, then nothing follows.
  explicit ChartImages(int half) : half_(half) {}

  /// Which charts are the exact images of others; those with the larger ids follow.
  void Pair(const ChartIds& ids);

  bool IsSymmetric() const { return half_ > 0; }
  bool Follows(int face) const { return half_ > 0 && follows_[face]; }
  bool IsFollowed(int face) const { return half_ > 0 && follows_[ImageOf(face)]; }

  /// The charts that follow get the parts, the seams and the mirrored maps of those they follow. `ids` are
  /// not compact afterwards.
  void Copy(ChartIds& ids, SeamMask& seams, std::vector<FaceUv>& uv) const;

  /// The chart at the mirror image of chart `id`; itself, or -1 where the image is not one whole chart.
  int ImageChart(const ChartIds& ids, int id) const;

  /// A chart that is its own image becomes two at the plane. The part next to chart `neighbour` keeps the id;
  /// returns that of the other.
  int TakeApart(const SurfaceGraph<SurfaceMesh>& surface, int id, int neighbour, ChartIds& ids,
                SeamMask& seams) const;

 private:
  int ImageOf(int face) const { return face < half_ ? face + half_ : face - half_; }

  int half_;
  std::vector<char> follows_;  // per face
};

}  // namespace dcharts
