// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/same_shape.h"

#include <cmath>

#include "pattern/surface/data_coordinates.h"

namespace dcharts {
namespace {

double TotalArea(const SurfaceData& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.faces) {
    const Eigen::Vector3d p = PositionOf(mesh, a);
    area += (PositionOf(mesh, b) - p).cross(PositionOf(mesh, c) - p).norm() / 2;
  }
  return area;
}

bool IsWithin(const SurfaceData& mesh, const FaceTree& other, const ShapeLimits& limits) {
  std::vector<char> seen(mesh.vertices.size(), 0);
  int vertices = 0, far = 0;
  for (const auto& face : mesh.faces)
    for (int v : face) {
      if (seen[v]) continue;
      seen[v] = 1;
      ++vertices;
      const double distance = other.Find(PositionOf(mesh, v)).distance;
      if (distance <= limits.distance) continue;
      if (distance > limits.farthest) return false;
      ++far;
    }
  return far <= limits.rare * vertices;
}

}  // namespace

bool AreSameShape(const SurfaceData& a, const SurfaceData& b, const ShapeLimits& limits) {
  const double area = TotalArea(a);
  return std::abs(TotalArea(b) - area) <= limits.area * area && IsWithin(a, FaceTree(b), limits) &&
         IsWithin(b, FaceTree(a), limits);
}

std::vector<int> FacesAtPlacesOf(const FaceTree& from, const FaceTree& to) {
  std::vector<int> faces;
  for (int f = 0; f < from.FaceCount(); ++f)
    faces.push_back(to.FindFacing(from.Centroid(f), from.Normal(f)).face);
  return faces;
}

}  // namespace dcharts
