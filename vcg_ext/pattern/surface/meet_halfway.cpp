// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/meet_halfway.h"

#include <algorithm>
#include <vector>

#include "pattern/surface/data_coordinates.h"
#include "pattern/surface/face_tree.h"

namespace dcharts {
namespace {

using Eigen::Vector3d;

/// Per vertex the farthest way that it has to go.
class Ways {
 public:
  Ways(size_t vertices, double distance) : ways_(vertices, Vector3d::Zero()), distance_(distance) {}

  // `way`: all of the difference.
  void Add(int vertex, const Vector3d& way) {
    const double length = way.norm();
    if (length <= distance_) return;
    const Vector3d share = std::min(0.5, 1 - distance_ / length) * way;
    if (share.squaredNorm() > ways_[vertex].squaredNorm()) ways_[vertex] = share;
  }

  const Vector3d& operator[](int vertex) const { return ways_[vertex]; }
  bool Any() const {
    return std::any_of(ways_.begin(), ways_.end(), [](const Vector3d& way) { return !way.isZero(0); });
  }

 private:
  std::vector<Vector3d> ways_;
  const double distance_;
};

std::vector<Vector3d> VertexNormals(const SurfaceData& mesh) {
  std::vector<Vector3d> normals(mesh.vertices.size(), Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.faces) {
    const Vector3d p = PositionOf(mesh, a);
    const Vector3d normal = (PositionOf(mesh, b) - p).cross(PositionOf(mesh, c) - p);
    for (int v : {a, b, c}) normals[v] += normal;
  }
  for (Vector3d& n : normals) n.normalize();
  return normals;
}

void AddWaysToUsers(const FaceTree& users, const SurfaceData& mesh, Ways& ways) {
  const std::vector<Vector3d> normals = VertexNormals(mesh);
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    const Vector3d p = PositionOf(mesh, v);
    ways.Add(v, users.FindFacing(p, normals[v]).point - p);
  }
}

// For what sticks out of the mesh, which none of the mesh's own vertices is drawn to.
void AddWaysToTips(const SurfaceData& users, const std::vector<Vector3d>& users_normals,
                   const SurfaceData& mesh, Ways& ways) {
  const FaceTree tree(mesh);
  for (int u = 0; u < static_cast<int>(users.vertices.size()); ++u) {
    if (users_normals[u].isZero(0)) continue;  // of no face
    const Vector3d p = PositionOf(users, u);
    const auto nearest = tree.FindFacing(p, users_normals[u]);
    const auto is_nearer = [&](int v, int w) {
      return (PositionOf(mesh, v) - nearest.point).norm() < (PositionOf(mesh, w) - nearest.point).norm();
    };
    const auto& corners = mesh.faces[nearest.face];
    ways.Add(*std::min_element(corners.begin(), corners.end(), is_nearer), p - nearest.point);
  }
}

}  // namespace

void MeetHalfway(const SurfaceData& users, double distance, const Vector3d& plane_normal,
                 SymmetricMesh& symmetric) {
  constexpr int kPasses = 4;
  const MirroredHalves& halves = symmetric.halves;
  const FaceTree users_tree(users);
  const std::vector<Vector3d> users_normals = VertexNormals(users);
  for (int pass = 0; pass < kPasses; ++pass) {
    const SurfaceData mesh = symmetric.mesh;
    Ways ways(mesh.vertices.size(), distance);
    AddWaysToUsers(users_tree, mesh, ways);
    AddWaysToTips(users, users_normals, mesh, ways);
    if (!ways.Any()) return;
    for (int f = 0; f < halves.half; ++f)
      for (int k = 0; k < 3; ++k) {
        const int v = mesh.faces[f][k], w = mesh.faces[halves.ImageOf(f)][(3 - k) % 3];
        const Vector3d mirrored = ways[w] - 2 * plane_normal.dot(ways[w]) * plane_normal;
        const Vector3d p = PositionOf(mesh, v) + ways[v] + mirrored;
        symmetric.mesh.vertices[v] = {p.x(), p.y(), p.z()};
      }
    MirrorFirstHalf(mesh, halves, symmetric.mesh);
  }
}

}  // namespace dcharts
