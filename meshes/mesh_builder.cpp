// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_builder.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "common/pi.h"
#include "planar_mesh.h"

namespace dcharts::shapes {

void RequireAtLeast(const char* what, int value, int minimum) {
  if (value < minimum)
    throw std::invalid_argument(std::string(what) + " must be at least " + std::to_string(minimum) +
                                ", not " + std::to_string(value) + ".");
}

int MeshBuilder::AddVertex(const Eigen::Vector3d& p) {
  mesh_.vertices.push_back({p.x(), p.y(), p.z()});
  return static_cast<int>(mesh_.vertices.size()) - 1;
}

void MeshBuilder::AddFace(int a, int b, int c) { mesh_.faces.push_back({a, b, c}); }

void MeshBuilder::AddQuad(int a, int b, int c, int d) {
  const double ac = (Position(a) - Position(c)).norm();
  const double bd = (Position(b) - Position(d)).norm();
  if (bd < ac * (1 - 1e-9)) {
    AddFace(a, b, d);
    AddFace(b, c, d);
  } else {
    AddFace(a, b, c);
    AddFace(a, c, d);
  }
}

void MeshBuilder::AddBand(const std::vector<int>& lower, const std::vector<int>& upper) {
  const size_t n = lower.size();
  for (size_t i = 0; i < n; ++i) {
    const size_t j = (i + 1) % n;
    AddQuad(lower[i], lower[j], upper[j], upper[i]);
  }
}

void MeshBuilder::AddFan(const std::vector<int>& ring, int apex) {
  const size_t n = ring.size();
  for (size_t i = 0; i < n; ++i) AddFace(ring[i], ring[(i + 1) % n], apex);
}

std::vector<int> MeshBuilder::AddRing(const Eigen::Vector2d& centre, double radius, int n, double z) {
  std::vector<int> ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * kPi * i / n;
    ring.push_back(
        AddVertex({centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle), z}));
  }
  return ring;
}

void MeshBuilder::AddFlat(const std::vector<std::vector<int>>& rings, double edge_length, Facing facing) {
  std::vector<std::vector<Eigen::Vector2d>> loops;
  std::vector<int> vertices;
  for (const auto& ring : rings) {
    loops.emplace_back();
    for (int v : ring) loops.back().push_back(Position(v).head<2>());
    vertices.insert(vertices.end(), ring.begin(), ring.end());
  }
  const double z = Position(rings[0][0]).z();
  const PlanarMesh flat = FillPolygon(loops, edge_length);
  for (size_t i = vertices.size(); i < flat.points.size(); ++i)
    vertices.push_back(AddVertex({flat.points[i].x(), flat.points[i].y(), z}));
  for (const auto& f : flat.faces) {
    const int a = vertices[static_cast<size_t>(f[0])], b = vertices[static_cast<size_t>(f[1])],
              c = vertices[static_cast<size_t>(f[2])];
    if (facing == Facing::kUp)
      AddFace(a, b, c);
    else
      AddFace(a, c, b);
  }
}

Eigen::Vector3d MeshBuilder::Position(int vertex) const {
  return Eigen::Vector3d(mesh_.vertices[static_cast<size_t>(vertex)].data());
}

SurfaceData MeshBuilder::Take() { return std::move(mesh_); }

void FlipFaces(SurfaceData& mesh) {
  for (auto& face : mesh.faces) std::swap(face[1], face[2]);
}

void Append(SurfaceData& mesh, const SurfaceData& other, const Eigen::Vector3d& offset) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (const auto& v : other.vertices)
    mesh.vertices.push_back({v[0] + offset.x(), v[1] + offset.y(), v[2] + offset.z()});
  for (const auto& f : other.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
}

SurfaceData Weld(const SurfaceData& mesh, double distance) {
  // A point may lie at the border of a grid cell, so the neighbouring cells are looked at too.
  using Cell = std::tuple<long long, long long, long long>;
  std::map<Cell, std::vector<int>> cells;
  SurfaceData welded;
  std::vector<int> new_index;
  for (const auto& v : mesh.vertices) {
    const long long x = std::llround(v[0] / distance);
    const long long y = std::llround(v[1] / distance);
    const long long z = std::llround(v[2] / distance);
    int found = -1;
    for (long long dx = -1; dx <= 1 && found < 0; ++dx)
      for (long long dy = -1; dy <= 1 && found < 0; ++dy)
        for (long long dz = -1; dz <= 1 && found < 0; ++dz) {
          const auto cell = cells.find({x + dx, y + dy, z + dz});
          if (cell == cells.end()) continue;
          for (int k : cell->second) {
            const auto& w = welded.vertices[static_cast<size_t>(k)];
            if (std::hypot(v[0] - w[0], v[1] - w[1], v[2] - w[2]) < distance) found = k;
          }
        }
    if (found < 0) {
      found = static_cast<int>(welded.vertices.size());
      welded.vertices.push_back(v);
      cells[{x, y, z}].push_back(found);
    }
    new_index.push_back(found);
  }
  for (const auto& f : mesh.faces)
    welded.faces.push_back({new_index[static_cast<size_t>(f[0])], new_index[static_cast<size_t>(f[1])],
                            new_index[static_cast<size_t>(f[2])]});
  return welded;
}

}  // namespace dcharts::shapes
