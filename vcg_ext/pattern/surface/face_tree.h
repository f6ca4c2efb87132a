// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "common/surface_data.h"

namespace dcharts {

/// Finds the face of a mesh that is nearest to a point: a tree of boxes.
class FaceTree {
 public:
  /// Of all faces; the mesh must have some. Keeps no reference to it.
  explicit FaceTree(const SurfaceData& mesh);

  struct Nearest {
    int face = -1;
    double distance = std::numeric_limits<double>::infinity();
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of the face
  };

  Nearest Find(const Eigen::Vector3d& p) const;

  /// Of the faces that look about the same way as `normal`; of all where none does.
  Nearest FindFacing(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const;

  int FaceCount() const { return static_cast<int>(faces_.size()); }
  const Eigen::Vector3d& Centroid(int face) const { return faces_[face].centroid; }
  const Eigen::Vector3d& Normal(int face) const { return faces_[face].normal; }  ///< unit length, or zero

 private:
  struct Face {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::Vector3d centroid, normal;
  };
  struct Node {
    Eigen::AlignedBox3d box{};
    int first = 0, last = 0;  // of order_
    int left = -1, right = -1;
  };

  int Build(int first, int last);
  void Search(int node, const Eigen::Vector3d& p, const Eigen::Vector3d& normal, Nearest& best) const;

  std::vector<Face> faces_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace dcharts
