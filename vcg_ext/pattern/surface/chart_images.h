// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "pattern/surface/mirrored_halves.h"
#include "surface/charts.h"
#include "surface/surface_mesh.h"

namespace dcharts {

/// The texcoords of a face's corners: u0 v0 u1 v1 u2 v2.
using FaceUv = std::array<double, 6>;

/// Keeps charts of a symmetric mesh mirror images of each other: one of each pair is worked on, the other
/// follows it. See SymmetricMesh.
class ChartImages {
 public:
  /// Of a mesh that isn't symmetric nothing follows.
  explicit ChartImages(const MirroredHalves& halves) : halves_(halves) {}

  /// Which charts are the exact images of others, of which those with the larger ids follow, or of
  /// themselves.
  void Pair(const ChartIds& ids);

  const MirroredHalves& Halves() const { return halves_; }
  bool IsSymmetric() const { return halves_.IsSymmetric(); }
  bool Follows(int face) const { return IsSymmetric() && role_[face] == Role::kFollows; }
  bool IsFollowed(int face) const { return IsSymmetric() && role_[halves_.ImageOf(face)] == Role::kFollows; }
  /// The chart of the face is its own image.
  bool IsOwnImage(int face) const { return IsSymmetric() && role_[face] == Role::kOwnImage; }

  /// The charts that follow get the parts, the seams and the mirrored maps of those they follow. `ids` are
  /// not compact afterwards.
  void Copy(ChartIds& ids, SeamMask& seams, std::vector<FaceUv>& uv) const;

  /// The chart at the mirror image of chart `id`; itself, or -1 where the image is not one whole chart.
  int ImageChart(const ChartIds& ids, int id) const;

  /// A chart that is its own image becomes two at the plane, one of which follows the other.
  void PartAtPlane(const SurfaceGraph<SurfaceMesh>& surface, int id, int new_id, ChartIds& ids,
                   SeamMask& seams);

  /// The same, for the chart to be given to others. The part next to chart `neighbour` keeps the id;
  /// returns that of the other.
  int TakeApart(const SurfaceGraph<SurfaceMesh>& surface, int id, int neighbour, ChartIds& ids,
                SeamMask& seams) const;

 private:
  enum class Role : char { kAlone, kFollows, kOwnImage };

  MirroredHalves halves_;
  std::vector<Role> role_;  // per face
};

}  // namespace dcharts
