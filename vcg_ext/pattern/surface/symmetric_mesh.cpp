// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/symmetric_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "pattern/surface/data_coordinates.h"

namespace dcharts {
namespace {

using Surface = SurfaceGraph<SurfaceMesh>;

/// Cuts faces at height 0 and collects what is above.
class HalfCutter {
 public:
  HalfCutter(std::vector<Eigen::Vector3d> points, std::vector<double> heights)
      : points_(std::move(points)), heights_(std::move(heights)) {}

  void Add(const std::array<int, 3>& face) {
    std::vector<int> above;  // the corners of what is left
    bool any = false;
    for (int k = 0; k < 3; ++k) {
      const int v = face[k], w = face[(k + 1) % 3];
      any = any || heights_[v] > 0;
      if (heights_[v] >= 0) above.push_back(v);
      if (heights_[v] * heights_[w] < 0) above.push_back(Crossing(v, w));
    }
    if (!any) return;
    for (size_t k = 1; k + 1 < above.size(); ++k) faces_.push_back({above[0], above[k], above[k + 1]});
  }

  const std::vector<Eigen::Vector3d>& Points() const { return points_; }
  bool OnPlane(int v) const { return heights_[v] == 0; }
  const std::vector<std::array<int, 3>>& Faces() const { return faces_; }

 private:
  int Crossing(int v, int w) {
    const auto [it, is_new] = crossings_.insert({{std::min(v, w), std::max(v, w)}, 0});
    if (!is_new) return it->second;
    const int a = it->first.first, b = it->first.second;
    const double t = heights_[a] / (heights_[a] - heights_[b]);
    it->second = static_cast<int>(points_.size());
    const Eigen::Vector3d crossing = points_[a] + t * (points_[b] - points_[a]);
    points_.push_back(crossing);
    heights_.push_back(0);
    return it->second;
  }

  std::vector<Eigen::Vector3d> points_;
  std::vector<double> heights_;
  std::map<std::pair<int, int>, int> crossings_;
  std::vector<std::array<int, 3>> faces_;
};

// From the face that is furthest from its image.
MirrorPlane PlaneBetween(const SurfaceData& symmetric, const MirroredHalves& halves) {
  const auto centroid = [&](int f) -> Eigen::Vector3d {
    const auto& [a, b, c] = symmetric.faces[f];
    return (PositionOf(symmetric, a) + PositionOf(symmetric, b) + PositionOf(symmetric, c)) / 3;
  };
  MirrorPlane mirror;
  double farthest = 0;
  for (int f = 0; f < halves.half; ++f) {
    const Eigen::Vector3d p = centroid(f), q = centroid(halves.ImageOf(f)), d = p - q;
    if (d.norm() <= farthest) continue;
    farthest = d.norm();
    mirror.normal = d / farthest;
    mirror.offset = mirror.normal.dot(p + q) / 2;
  }
  return mirror;
}

}  // namespace

SymmetricMesh MakeSymmetricMesh(const SurfaceData& data, const Surface& surface, const MirrorPlane& mirror) {
  // All in the surface's coordinates, which are the data's moved and scaled.
  std::vector<double> shortest(surface.VertexCount(), std::numeric_limits<double>::infinity());
  for (int h = 0; h < surface.HalfEdgeCount(); ++h)
    for (int v : {surface.Vertex(h), surface.Vertex(Next(h))})
      shortest[v] = std::min(shortest[v], surface.Length(h));
  std::vector<Eigen::Vector3d> points;
  std::vector<double> heights;
  constexpr double kNear = 0.3;  // of the shortest edge: no slivers along the plane
  for (int v = 0; v < surface.VertexCount(); ++v) {
    points.push_back(surface.Position(v));
    heights.push_back(mirror.Height(points.back()));
    if (std::abs(heights.back()) > kNear * shortest[v]) continue;
    points.back() -= heights.back() * mirror.normal;
    heights.back() = 0;
  }
  HalfCutter cutter(std::move(points), std::move(heights));
  for (int f = 0; f < surface.FaceCount(); ++f)
    cutter.Add({surface.Vertex(3 * f), surface.Vertex(3 * f + 1), surface.Vertex(3 * f + 2)});

  const DataCoordinates to_data(data, surface);
  SymmetricMesh result;
  const auto add_vertex = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d q = to_data(p);
    result.mesh.vertices.push_back({q.x(), q.y(), q.z()});
    return static_cast<int>(result.mesh.vertices.size()) - 1;
  };
  std::vector<int> here(cutter.Points().size(), -1), there(cutter.Points().size(), -1);
  for (const auto& face : cutter.Faces())
    for (int v : face)
      if (here[v] < 0) here[v] = add_vertex(cutter.Points()[v]);
  for (const auto& face : cutter.Faces())
    for (int v : face)
      if (there[v] < 0)
        there[v] = cutter.OnPlane(v) ? here[v] : add_vertex(mirror.Mirrored(cutter.Points()[v]));
  for (const auto& [a, b, c] : cutter.Faces()) result.mesh.faces.push_back({here[a], here[b], here[c]});
  for (const auto& [a, b, c] : cutter.Faces()) result.mesh.faces.push_back({there[a], there[c], there[b]});
  result.halves.half = static_cast<int>(cutter.Faces().size());
  return result;
}

void MirrorFirstHalf(const SurfaceData& symmetric, const MirroredHalves& halves, SurfaceData& mesh) {
  const MirrorPlane mirror = PlaneBetween(symmetric, halves);
  const auto set = [&](int v, const Eigen::Vector3d& p) { mesh.vertices[v] = {p.x(), p.y(), p.z()}; };
  for (int f = 0; f < halves.half; ++f)
    for (int k = 0; k < 3; ++k) {
      // The image of face (a, b, c) is (a, c, b).
      const int v = mesh.faces[f][k], w = mesh.faces[halves.ImageOf(f)][(3 - k) % 3];
      const Eigen::Vector3d p = PositionOf(mesh, v);
      set(w, v == w ? Eigen::Vector3d(p - mirror.Height(p) * mirror.normal) : mirror.Mirrored(p));
    }
}

}  // namespace dcharts
