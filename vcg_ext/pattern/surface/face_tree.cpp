// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/face_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pattern/surface/data_coordinates.h"

namespace dcharts {
namespace {

using Eigen::Vector3d;

Vector3d NearestOnEdge(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d e = b - a;
  const double length = e.squaredNorm();
  return a + (length > 0 ? std::clamp((p - a).dot(e) / length, 0.0, 1.0) : 0) * e;
}

Vector3d NearestOnTriangle(const Vector3d& p, const std::array<Vector3d, 3>& corners,
                           const Vector3d& normal) {
  bool above = !normal.isZero(0);
  Vector3d nearest = corners[0];
  for (int k = 0; k < 3; ++k) {
    const Vector3d &a = corners[k], &b = corners[(k + 1) % 3];
    above = above && (b - a).cross(p - a).dot(normal) >= 0;
    const Vector3d q = NearestOnEdge(p, a, b);
    if ((p - q).squaredNorm() < (p - nearest).squaredNorm()) nearest = q;
  }
  return above ? Vector3d(p - normal.dot(p - corners[0]) * normal) : nearest;
}

}  // namespace

FaceTree::FaceTree(const SurfaceData& mesh) {
  for (const auto& face : mesh.faces) {
    Face f;
    for (int k = 0; k < 3; ++k) f.corners[k] = PositionOf(mesh, face[k]);
    f.centroid = (f.corners[0] + f.corners[1] + f.corners[2]) / 3;
    const Vector3d n = (f.corners[1] - f.corners[0]).cross(f.corners[2] - f.corners[0]);
    f.normal = n.norm() > 0 ? Vector3d(n.normalized()) : Vector3d::Zero();
    order_.push_back(static_cast<int>(faces_.size()));
    faces_.push_back(f);
  }
  Build(0, static_cast<int>(faces_.size()));
}

int FaceTree::Build(int first, int last) {
  constexpr int kFew = 8;
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.first = first;
  node.last = last;
  Eigen::AlignedBox3d centroids;
  for (int k = first; k < last; ++k) {
    for (const Vector3d& corner : faces_[order_[k]].corners) node.box.extend(corner);
    centroids.extend(faces_[order_[k]].centroid);
  }
  if (last - first > kFew) {
    int axis = 0;
    centroids.sizes().maxCoeff(&axis);
    const int middle = (first + last) / 2;
    std::nth_element(
        order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int i, int j) {
          return std::make_pair(faces_[i].centroid[axis], i) < std::make_pair(faces_[j].centroid[axis], j);
        });
    node.left = Build(first, middle);
    node.right = Build(middle, last);
  }
  nodes_[index] = node;
  return index;
}

void FaceTree::Search(int index, const Vector3d& p, const Vector3d& normal, Nearest& best) const {
  const Node& node = nodes_[index];
  if (node.left < 0) {
    for (int k = node.first; k < node.last; ++k) {
      const int f = order_[k];
      constexpr double kAboutTheSame = 0.3;  // cosine
      if (!normal.isZero(0) && faces_[f].normal.dot(normal) < kAboutTheSame) continue;
      const Vector3d point = NearestOnTriangle(p, faces_[f].corners, faces_[f].normal);
      const double distance = (p - point).norm();
      if (distance < best.distance || (distance == best.distance && f < best.face))
        best = {f, distance, point};
    }
    return;
  }
  int near = node.left, far = node.right;
  if (nodes_[far].box.exteriorDistance(p) < nodes_[near].box.exteriorDistance(p)) std::swap(near, far);
  for (int child : {near, far})
    if (nodes_[child].box.exteriorDistance(p) <= best.distance) Search(child, p, normal, best);
}

FaceTree::Nearest FaceTree::Find(const Vector3d& p) const {
  Nearest best;
  Search(0, p, Vector3d::Zero(), best);
  return best;
}

FaceTree::Nearest FaceTree::FindFacing(const Vector3d& p, const Vector3d& normal) const {
  Nearest best;
  Search(0, p, normal, best);
  return best.face >= 0 ? best : Find(p);
}

}  // namespace dcharts
