// SPDX-License-Identifier: GPL-3.0-or-later
#include "implicit_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "mesh_builder.h"

namespace dcharts::shapes {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// One vertex per grid cell that the surface crosses, one quad per grid edge that it crosses.
SurfaceData SurfaceNets(const ImplicitFunction& function, const Vector3d& low, const Vector3d& high,
                        double cell) {
  const Vector3i nodes = ((high - low) / cell).array().ceil().cast<int>() + 1;
  const auto index = [&](const Vector3i& i) {
    return static_cast<size_t>((i.z() * nodes.y() + i.y()) * nodes.x() + i.x());
  };
  const auto position = [&](const Vector3i& i) -> Vector3d { return low + cell * i.cast<double>(); };
  const size_t total = index(nodes - Vector3i::Ones()) + 1;
  std::vector<double> value(total);
  Vector3i i;
  for (i.z() = 0; i.z() < nodes.z(); ++i.z())
    for (i.y() = 0; i.y() < nodes.y(); ++i.y())
      for (i.x() = 0; i.x() < nodes.x(); ++i.x()) value[index(i)] = function(position(i));

  MeshBuilder builder;
  std::vector<int> cell_vertex(total, -1);
  for (i.z() = 0; i.z() + 1 < nodes.z(); ++i.z())
    for (i.y() = 0; i.y() + 1 < nodes.y(); ++i.y())
      for (i.x() = 0; i.x() + 1 < nodes.x(); ++i.x()) {
        Vector3d sum = Vector3d::Zero();
        int crossings = 0;
        for (int axis = 0; axis < 3; ++axis)
          for (int side = 0; side < 4; ++side) {
            Vector3i a = i;
            a[(axis + 1) % 3] += side & 1;
            a[(axis + 2) % 3] += side >> 1;
            const Vector3i b = a + Vector3i::Unit(axis);
            const double fa = value[index(a)], fb = value[index(b)];
            if ((fa < 0) == (fb < 0)) continue;
            sum += position(a) + fa / (fa - fb) * (position(b) - position(a));
            ++crossings;
          }
        if (crossings > 0) cell_vertex[index(i)] = builder.AddVertex(sum / crossings);
      }
  for (i.z() = 1; i.z() + 1 < nodes.z(); ++i.z())
    for (i.y() = 1; i.y() + 1 < nodes.y(); ++i.y())
      for (i.x() = 1; i.x() + 1 < nodes.x(); ++i.x())
        for (int axis = 0; axis < 3; ++axis) {
          const bool inside = value[index(i)] < 0;
          if (inside == (value[index(i + Vector3i::Unit(axis))] < 0)) continue;
          const Vector3i u = Vector3i::Unit((axis + 1) % 3), v = Vector3i::Unit((axis + 2) % 3);
          const std::array<int, 4> quad{cell_vertex[index(i - u - v)], cell_vertex[index(i - v)],
                                        cell_vertex[index(i)], cell_vertex[index(i - u)]};
          if (inside)
            builder.AddQuad(quad[0], quad[1], quad[2], quad[3]);
          else
            builder.AddQuad(quad[3], quad[2], quad[1], quad[0]);
        }
  return builder.Take();
}

Vector3d Gradient(const ImplicitFunction& function, const Vector3d& p, double step) {
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d d = step * Vector3d::Unit(axis);
    gradient[axis] = (function(p + d) - function(p - d)) / (2 * step);
  }
  return gradient;
}

/// A few Newton steps along the gradient.
Vector3d ProjectToZero(const ImplicitFunction& function, Vector3d p, double cell, int steps) {
  for (int k = 0; k < steps; ++k) {
    const Vector3d gradient = Gradient(function, p, 1e-4 * cell);
    p -= function(p) / std::max(gradient.squaredNorm(), 1e-12) * gradient;
  }
  return p;
}

Vector3d At(const SurfaceData& mesh, int vertex) {
  return Vector3d(mesh.vertices[static_cast<size_t>(vertex)].data());
}

double CornerAngle(const Vector3d& at, const Vector3d& a, const Vector3d& b) {
  return std::atan2((a - at).cross(b - at).norm(), (a - at).dot(b - at));
}

/// Flips edges whose opposite angles sum to more than a half turn, until none is left (bounded).
void FlipToDelaunay(SurfaceData& mesh) {
  for (int round = 0; round < 20; ++round) {
    std::map<std::pair<int, int>, std::vector<int>> edge_faces;
    for (size_t f = 0; f < mesh.faces.size(); ++f)
      for (size_t i = 0; i < 3; ++i)
        edge_faces[std::minmax(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3])].push_back(static_cast<int>(f));
    std::vector<char> touched(mesh.faces.size(), 0);
    int flips = 0;
    for (const auto& [edge, faces] : edge_faces) {
      if (faces.size() != 2) continue;
      const size_t f0 = static_cast<size_t>(faces[0]), f1 = static_cast<size_t>(faces[1]);
      if (touched[f0] || touched[f1]) continue;
      auto &face0 = mesh.faces[f0], &face1 = mesh.faces[f1];
      size_t i = 0, j = 0;  // corners opposite to the edge
      while (face0[i] == edge.first || face0[i] == edge.second) ++i;
      while (face1[j] == edge.first || face1[j] == edge.second) ++j;
      const int a = face0[(i + 1) % 3], b = face0[(i + 2) % 3], c = face0[i], d = face1[j];
      if (edge_faces.count(std::minmax(c, d)) > 0) continue;
      const double sum = CornerAngle(At(mesh, c), At(mesh, a), At(mesh, b)) +
                         CornerAngle(At(mesh, d), At(mesh, a), At(mesh, b));
      if (sum < 3.1416) continue;
      face0 = {c, a, d};
      face1 = {d, b, c};
      touched[f0] = touched[f1] = 1;
      ++flips;
    }
    if (flips == 0) return;
  }
}

/// Moves each vertex towards the area-weighted middle of its faces, within the surface.
void SmoothOnSurface(SurfaceData& mesh, const ImplicitFunction& function, double cell) {
  std::vector<Vector3d> sum(mesh.vertices.size(), Vector3d::Zero());
  std::vector<double> weight(mesh.vertices.size(), 0);
  for (const auto& f : mesh.faces) {
    const Vector3d a = At(mesh, f[0]), b = At(mesh, f[1]), c = At(mesh, f[2]);
    const double area = (b - a).cross(c - a).norm();
    for (int v : f) {
      sum[static_cast<size_t>(v)] += area * (a + b + c) / 3;
      weight[static_cast<size_t>(v)] += area;
    }
  }
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector3d p(mesh.vertices[v].data());
    const Vector3d moved = ProjectToZero(function, p + 0.7 * (sum[v] / weight[v] - p), cell, 1);
    mesh.vertices[v] = {moved.x(), moved.y(), moved.z()};
  }
}

}  // namespace

SurfaceData PolygonizeImplicit(const ImplicitFunction& function, const Vector3d& low, const Vector3d& high,
                               double cell) {
  SurfaceData mesh = SurfaceNets(function, low, high, cell);
  for (int round = 0; round < 40; ++round) {
    SmoothOnSurface(mesh, function, cell);
    if (round % 4 == 1) FlipToDelaunay(mesh);
  }
  FlipToDelaunay(mesh);
  for (auto& vertex : mesh.vertices) {
    const Vector3d p = ProjectToZero(function, Vector3d(vertex.data()), cell, 6);
    vertex = {p.x(), p.y(), p.z()};
  }
  return mesh;
}

double SmoothUnion(double a, double b, double radius) {
  const double h = std::max(radius - std::abs(a - b), 0.0) / radius;
  return std::min(a, b) - h * h * radius / 4;
}

}  // namespace dcharts::shapes
