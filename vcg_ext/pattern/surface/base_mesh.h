// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "common/surface_data.h"
#include "pattern/pattern.h"
#include "pattern/surface/mirrored_halves.h"
#include "pattern/surface/same_shape.h"
#include "surface/workspace.h"

namespace dcharts {

/// The mesh that pieces are made on, with its surface: the user's, or one of the same shape that is better
/// for it.
class BaseMesh {
 public:
  /// Throws Error for a mesh that is refused, see BuildSurface. `users` must outlive this. `poll` is called
  /// now and then and may throw.
  explicit BaseMesh(
      const SurfaceData& users, std::function<void()> poll = [] {})
      : users_(users), mesh_(&users), poll_(std::move(poll)) {
    work_.emplace(users, poll_);
  }

  const SurfaceData& Mesh() const { return *mesh_; }
  Workspace& Work() { return *work_; }
  const SurfaceGraph<SurfaceMesh>& Surface() const { return work_->Surface(); }
  /// Of the mesh when it is exactly symmetric, see MakeSymmetric.
  const MirroredHalves& Halves() const { return halves_; }

  void Coarsen(PatternMaterial material);  ///< see CoarseMesh
  /// Where there is a plane of symmetry, and it changes nothing that matters for the material, one half
  /// becomes the exact mirror image of the other.
  void MakeSymmetric(PatternMaterial material);

  /// Sets piece_of_face, and has all faces in the pattern be those of the user's mesh.
  void ToUsersFaces(Pattern& pattern) const;

 private:
  void Take(SurfaceData& here, SurfaceData mesh);
  ShapeLimits LimitsOfSymmetry(PatternMaterial material) const;

  const SurfaceData& users_;
  SurfaceData coarse_, symmetric_;
  const SurfaceData* mesh_;
  const std::function<void()> poll_;
  std::optional<Workspace> work_;
  MirroredHalves halves_;
};

}  // namespace dcharts
