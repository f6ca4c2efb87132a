// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>

#include "common/pi.h"
#include "implicit_mesh.h"
#include "mesh_builder.h"
#include "shapes.h"

namespace dcharts::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWeldDistance = 1e-7;

/// Grid of n by m cells over the unit square, mapped to space.
template <class Map>
SurfaceData MappedGrid(int n, int m, const Map& map) {
  MeshBuilder builder;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i)
      builder.AddVertex(map(static_cast<double>(i) / n, static_cast<double>(j) / m));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      builder.AddQuad(a, a + 1, a + n + 2, a + n + 1);
    }
  return builder.Take();
}

/// Rings of 6 k vertices around one, mapped from the unit disk to space.
template <class Map>
SurfaceData MappedDisk(int rings, const Map& map) {
  MeshBuilder builder;
  builder.AddVertex(map(Vector2d(0, 0)));
  const auto first = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int k = 1; k <= rings; ++k)
    for (int i = 0; i < 6 * k; ++i) {
      const double angle = 2 * kPi * i / (6 * k);
      builder.AddVertex(map(static_cast<double>(k) / rings * Vector2d(std::cos(angle), std::sin(angle))));
    }
  for (int k = 1; k <= rings; ++k)
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i < k; ++i) {
        const auto outer = [&](int j) { return first(k) + (sector * k + j) % (6 * k); };
        const auto inner = [&](int j) {
          return k == 1 ? 0 : first(k - 1) + (sector * (k - 1) + j) % (6 * (k - 1));
        };
        builder.AddFace(outer(i), outer(i + 1), inner(i));
        if (i + 1 < k) builder.AddFace(outer(i + 1), inner(i + 1), inner(i));
      }
  return builder.Take();
}

enum class Caps { kNone, kBottom, kBoth };

SurfaceData Cylinder(int n, Caps caps) {
  RequireAtLeast("The number of sides", n, 3);
  MeshBuilder builder;
  const int levels = std::max(1, static_cast<int>(std::lround(n / kPi)));
  std::vector<std::vector<int>> rings;
  for (int k = 0; k <= levels; ++k) {
    rings.push_back(builder.AddRing(Vector2d(0, 0), 0.5, n, static_cast<double>(k) / levels));
    if (k > 0) builder.AddBand(rings[rings.size() - 2], rings.back());
  }
  if (caps == Caps::kBoth) {
    const double edge = kPi / n;
    builder.AddFlat({rings.front()}, edge, Facing::kDown);
    builder.AddFlat({rings.back()}, edge, Facing::kUp);
  }
  return builder.Take();
}

SurfaceData Cone(int n, Caps caps) {
  RequireAtLeast("The number of sides", n, 3);
  MeshBuilder builder;
  // All rings have n vertices, so that the sides stay flat. Rings get closer towards the apex in proportion
  // to their radius; the last seventh is one fan.
  const double shrink = 1 - std::min(0.5, 4 * kPi / n * 0.5);
  std::vector<int> ring = builder.AddRing(Vector2d(0, 0), 0.5, n, 0);
  if (caps == Caps::kBottom) builder.AddFlat({ring}, kPi / n, Facing::kDown);
  for (double radius = 0.5 * shrink; radius > 0.07; radius *= shrink) {
    const std::vector<int> next = builder.AddRing(Vector2d(0, 0), radius, n, 1 - 2 * radius);
    builder.AddBand(ring, next);
    ring = next;
  }
  builder.AddFan(ring, builder.AddVertex(Vector3d(0, 0, 1)));
  return builder.Take();
}

}  // namespace

SurfaceData Grid(int n, int m) {
  RequireAtLeast("The number of cells", std::min(n, m), 1);
  return MappedGrid(n, m, [](double u, double v) { return Vector3d(u, v, 0); });
}

SurfaceData Disk(int rings) {
  RequireAtLeast("The number of rings", rings, 1);
  return MappedDisk(rings, [](const Vector2d& p) { return Vector3d(p.x(), p.y(), 0); });
}

SurfaceData PlaneWithHole(int n) {
  RequireAtLeast("The number of edges per side", n, 8);
  MeshBuilder builder;
  std::vector<int> square;
  const std::array<Vector2d, 4> corners{Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(0, 1)};
  for (size_t side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i) {
      const Vector2d p =
          corners[side] + static_cast<double>(i) / n * (corners[(side + 1) % 4] - corners[side]);
      square.push_back(builder.AddVertex(Vector3d(p.x(), p.y(), 0)));
    }
  const std::vector<int> hole = builder.AddRing(Vector2d(0.5, 0.5), 0.25, 4 * n, 0);
  builder.AddFlat({square, hole}, 1.0 / n, Facing::kUp);
  return builder.Take();
}

SurfaceData SphericalCap(int rings, double angle) {
  RequireAtLeast("The number of rings", rings, 2);
  if (!(angle > 0 && angle < kPi)) throw std::invalid_argument("The angle must lie between 0 and pi.");
  return MappedDisk(rings, [angle](const Vector2d& p) {
    const double polar = angle * p.norm();
    const Vector2d side = p.norm() > 0 ? Vector2d(std::sin(polar) / p.norm() * p) : Vector2d(0, 0);
    return Vector3d(side.x(), side.y(), std::cos(polar));
  });
}

SurfaceData SaddleRidge(int n) {
  RequireAtLeast("The number of cells", n, 2);
  return MappedGrid(n, n, [](double u, double v) {
    const double x = 2 * u - 1, y = 2 * v - 1;
    return Vector3d(x, y, (x * x - y * y) / 2);
  });
}

SurfaceData MoebiusStrip(int n) {
  RequireAtLeast("The number of cells", n, 12);
  const int across = std::max(2, static_cast<int>(std::lround(0.6 * n / (2 * kPi))));
  const SurfaceData strip = MappedGrid(n, across, [](double u, double v) {
    const double around = 2 * kPi * u, twist = kPi * u, side = 0.6 * (v - 0.5);
    const double radius = 1 + side * std::cos(twist);
    return Vector3d(radius * std::cos(around), radius * std::sin(around), side * std::sin(twist));
  });
  return Weld(strip, kWeldDistance);
}

SurfaceData OpenCylinder(int n) { return Cylinder(n, Caps::kNone); }
SurfaceData ClosedCylinder(int n) { return Cylinder(n, Caps::kBoth); }

SurfaceData OpenFrustum(int n) {
  RequireAtLeast("The number of sides", n, 3);
  MeshBuilder builder;
  const int levels = std::max(1, static_cast<int>(std::lround(n / 4.5)));
  std::vector<int> ring;
  for (int k = 0; k <= levels; ++k) {
    const double z = static_cast<double>(k) / levels;
    const std::vector<int> next = builder.AddRing(Vector2d(0, 0), 1 - z / 2, n, z);
    if (k > 0) builder.AddBand(ring, next);
    ring = next;
  }
  return builder.Take();
}

SurfaceData OpenCone(int n) { return Cone(n, Caps::kNone); }
SurfaceData ClosedCone(int n) { return Cone(n, Caps::kBottom); }

SurfaceData Cube(int n) {
  RequireAtLeast("The number of cells", n, 1);
  SurfaceData cube;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      SurfaceData face = MappedGrid(n, n, [axis, side](double u, double v) {
        Vector3d p;
        p[axis] = side;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return p;
      });
      if (side == 0) FlipFaces(face);
      Append(cube, face, Vector3d::Zero());
    }
  return Weld(cube, kWeldDistance);
}

SurfaceData Sphere(int n) {
  RequireAtLeast("The number of parts of an edge", n, 1);
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Vector3d, 12> corners{Vector3d(-1, g, 0),  Vector3d(1, g, 0),   Vector3d(-1, -g, 0),
                                         Vector3d(1, -g, 0),  Vector3d(0, -1, g),  Vector3d(0, 1, g),
                                         Vector3d(0, -1, -g), Vector3d(0, 1, -g),  Vector3d(g, 0, -1),
                                         Vector3d(g, 0, 1),   Vector3d(-g, 0, -1), Vector3d(-g, 0, 1)};
  SurfaceData sphere;
  for (size_t i = 0; i < 12; ++i)
    for (size_t j = 0; j < 12; ++j)
      for (size_t k = 0; k < 12; ++k) {
        // The icosahedron's edges are 2 long; take each outward face once.
        const Vector3d &a = corners[i], &b = corners[j], &c = corners[k];
        if (!(i < j && i < k && j != k) || (a - b).norm() > 2.1 || (b - c).norm() > 2.1 ||
            (c - a).norm() > 2.1 || (b - a).cross(c - a).dot(a) < 0)
          continue;
        MeshBuilder builder;
        const auto at = [n](int row, int column) { return row * (n + 1) - row * (row - 1) / 2 + column; };
        for (int r = 0; r <= n; ++r)
          for (int s = 0; s + r <= n; ++s) builder.AddVertex((a * (n - r - s) + b * s + c * r).normalized());
        for (int r = 0; r < n; ++r)
          for (int s = 0; s + r < n; ++s) {
            builder.AddFace(at(r, s), at(r, s + 1), at(r + 1, s));
            if (s + r + 1 < n) builder.AddFace(at(r, s + 1), at(r + 1, s + 1), at(r + 1, s));
          }
        Append(sphere, builder.Take(), Vector3d::Zero());
      }
  return Weld(sphere, kWeldDistance);
}

SurfaceData Torus(int n) {
  RequireAtLeast("The number of cells", n, 6);
  const SurfaceData tube = MappedGrid(static_cast<int>(std::lround(2.5 * n)), n, [](double u, double v) {
    const double around = 2 * kPi * u, tube_angle = 2 * kPi * v;
    const double radius = 1 + 0.4 * std::cos(tube_angle);
    return Vector3d(radius * std::cos(around), radius * std::sin(around), 0.4 * std::sin(tube_angle));
  });
  return Weld(tube, kWeldDistance);
}

SurfaceData DoubleTorus(int n) {
  RequireAtLeast("The number of cells", n, 32);
  const auto torus = [](const Vector3d& p, double x) {
    const double ring = std::hypot(p.x() - x, p.y()) - 0.6;
    return std::hypot(ring, p.z()) - 0.25;
  };
  const auto function = [&](const Vector3d& p) { return SmoothUnion(torus(p, -0.75), torus(p, 0.75), 0.3); };
  return PolygonizeImplicit(function, Vector3d(-1.75, -1.0, -0.45), Vector3d(1.75, 1.0, 0.45), 3.2 / n);
}

SurfaceData TwoComponents(int n) {
  SurfaceData both = Sphere(n);
  Append(both, Cube(n), Vector3d(2, -0.5, -0.5));
  return both;
}

SurfaceData BowTie(int n) {
  SurfaceData both = Grid(n, n);
  Append(both, Grid(n, n), Vector3d(1, 1, 0));
  return Weld(both, kWeldDistance);
}

SurfaceData NonManifoldFin(int n) {
  SurfaceData sheets = Grid(n, n);
  Append(sheets, Grid(n, n), Vector3d(-1, 0, 0));
  Append(sheets, MappedGrid(n, n, [](double u, double v) { return Vector3d(0, u, v); }), Vector3d::Zero());
  return Weld(sheets, kWeldDistance);
}

}  // namespace dcharts::shapes
