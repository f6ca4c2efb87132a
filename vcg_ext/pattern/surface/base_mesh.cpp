// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/base_mesh.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "pattern/surface/coarse_mesh.h"
#include "pattern/surface/data_coordinates.h"
#include "pattern/surface/meet_halfway.h"
#include "pattern/surface/mirror_plane.h"
#include "pattern/surface/same_shape.h"
#include "pattern/surface/symmetric_mesh.h"
#include "surface/denoised_normals.h"

namespace dcharts {

void BaseMesh::Take(SurfaceData& here, SurfaceData mesh) {
  here = std::move(mesh);
  mesh_ = &here;
  work_.emplace(here, poll_);
}

void BaseMesh::Coarsen(PatternMaterial material) {
  std::optional<SurfaceData> coarse = CoarseMesh(*mesh_, Surface(), material);
  if (coarse) Take(coarse_, std::move(*coarse));
}

// What is smaller than part of an edge is an accident of the triangles, at few vertices up to half of one: a
// narrow groove goes from edge to edge. Noise is larger at some vertices than it is on average. Paper keeps
// nearer to the model than fabric does, but for a few more vertices.
ShapeLimits BaseMesh::LimitsOfSymmetry(PatternMaterial material) const {
  constexpr double kOfSize = 2e-3, kOfEdge = 0.25, kMostOfSize = 6e-3, kArea = 1e-3;
  constexpr double kRare = 2e-3, kRareOfPaper = 5e-3, kFarther = 2;  // times as far
  constexpr double kOfNoise = 5, kAreaOfNoise = 0.1;
  const double size = LongestSide(*mesh_), noise = VertexNoise(Surface());
  double edge = 0;
  for (int h = 0; h < Surface().HalfEdgeCount(); ++h) edge += Surface().Length(h) / Surface().HalfEdgeCount();
  edge *= DataCoordinates(*mesh_, Surface()).Scale();
  const double of_size = kOfSize * size, of_noise = kOfNoise * noise * edge;
  const double accident = std::max(of_size, std::min(kOfEdge * edge, kMostOfSize * size));
  const bool is_paper = material == PatternMaterial::kPaper;
  ShapeLimits limits;
  limits.distance = (is_paper ? of_size : accident) + of_noise;
  limits.area = kArea + kAreaOfNoise * noise;
  limits.rare = is_paper ? kRareOfPaper : kRare;
  limits.farthest = kFarther * accident + of_noise;
  return limits;
}

void BaseMesh::MakeSymmetric(PatternMaterial material) {
  const auto mirror = FindMirrorPlane(Surface());
  if (!mirror) return;
  SymmetricMesh symmetric = MakeSymmetricMesh(*mesh_, Surface(), *mirror);
  const ShapeLimits limits = LimitsOfSymmetry(material);
  if (!AreSameShape(*mesh_, symmetric.mesh, limits)) return;
  MeetHalfway(*mesh_, limits.distance, mirror->normal, symmetric);
  Take(symmetric_, std::move(symmetric.mesh));
  halves_ = symmetric.halves;
}

void BaseMesh::ToUsersFaces(Pattern& pattern) const {
  std::vector<int>& piece_of_face = pattern.piece_of_face;
  piece_of_face.assign(mesh_->faces.size(), -1);
  for (const Piece& piece : pattern.pieces)
    for (int f : piece.flat.face) piece_of_face[f] = piece.id;
  if (mesh_ == &users_) return;
  const FaceTree base_tree(*mesh_), users_tree(users_);
  const std::vector<int> users = FacesAtPlacesOf(base_tree, users_tree);
  for (Piece& piece : pattern.pieces)
    for (int& f : piece.flat.face) f = users[f];
  std::vector<int> pieces;
  for (int f : FacesAtPlacesOf(users_tree, base_tree)) pieces.push_back(piece_of_face[f]);
  piece_of_face = std::move(pieces);
}

}  // namespace dcharts
