// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <vcg/complex/complex.h>
#include <vcg/complex/algorithms/update/topology.h>

#include "common/surface_data.h"

namespace dcharts {

class SurfaceVertex;
class SurfaceFace;

struct SurfaceTypes
    : vcg::UsedTypes<vcg::Use<SurfaceVertex>::AsVertexType, vcg::Use<SurfaceFace>::AsFaceType> {};

class SurfaceVertex : public vcg::Vertex<SurfaceTypes, vcg::vertex::Coord3d, vcg::vertex::BitFlags> {};

class SurfaceFace
    : public vcg::Face<SurfaceTypes, vcg::face::VertexRef, vcg::face::FFAdj, vcg::face::BitFlags> {};

/// The mesh the pipeline works on: double precision in every host.
class SurfaceMesh : public vcg::tri::TriMesh<std::vector<SurfaceVertex>, std::vector<SurfaceFace>> {};

/// What BuildSurface made of a host's mesh.
struct BuiltSurface {
  std::vector<int> source_face;  ///< per face of the surface mesh: its index in SurfaceData
};

/// Copies `data` into `mesh` (cleared first), centred and scaled to unit area, with face-face topology.
/// Faces with a repeated vertex are left out: they have no area and would break the topology.
/// Throws Error, with a sentence for the user, for: no faces, NaN or infinite coordinates, a surface of zero
/// area. `poll` is called now and then and may throw.
BuiltSurface BuildSurface(
    const SurfaceData& data, SurfaceMesh& mesh, const std::function<void()>& poll = [] {});

}  // namespace dcharts
