// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of every kind that files hold: each made by code, with what is to become of it.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mesh_builder.h"
#include "shapes.h"

namespace dcharts::test {

/// A mesh, and a word of the sentence that refuses it; null where it must be taken.
struct CorpusEntry {
  const char* name;
  SurfaceData (*make)();
  const char* no_atlas = nullptr;
  const char* no_pattern = nullptr;  ///< of fabric, 300 mm long
};

inline std::ostream& operator<<(std::ostream& out, const CorpusEntry& entry) { return out << entry.name; }

namespace corpus {

/// The surface of the unit cells of a lattice for which `filled` is true. Cells share vertices.
inline SurfaceData Voxels(int nx, int ny, int nz, const std::function<bool(int, int, int)>& filled) {
  SurfaceData mesh;
  std::vector<int> number(static_cast<std::size_t>((nx + 1) * (ny + 1) * (nz + 1)), -1);
  const auto vertex = [&](const std::array<int, 3>& at) {
    int& v = number[static_cast<std::size_t>((at[0] * (ny + 1) + at[1]) * (nz + 1) + at[2])];
    if (v < 0) {
      v = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back({double(at[0]), double(at[1]), double(at[2])});
    }
    return v;
  };
  const auto is_filled = [&](const std::array<int, 3>& c) {
    return c[0] >= 0 && c[0] < nx && c[1] >= 0 && c[1] < ny && c[2] >= 0 && c[2] < nz &&
           filled(c[0], c[1], c[2]);
  };
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z)
        for (std::size_t d = 0; d < 3; ++d)
          for (const int side : {0, 1}) {
            const std::array<int, 3> cell{x, y, z};
            std::array<int, 3> beyond = cell, a = cell;
            beyond[d] += side == 1 ? 1 : -1;
            if (!is_filled(cell) || is_filled(beyond)) continue;
            a[d] += side;
            std::array<int, 3> b = a, c = a, e = a;
            ++b[(d + 1) % 3];
            ++c[(d + 1) % 3];
            ++c[(d + 2) % 3];
            ++e[(d + 2) % 3];
            if (side == 0) std::swap(b, e);
            mesh.faces.push_back({vertex(a), vertex(b), vertex(c)});
            mesh.faces.push_back({vertex(a), vertex(c), vertex(e)});
          }
  return mesh;
}

/// A block with this many holes through it in a row.
template <int kGenus>
SurfaceData Handles() {
  return Voxels(2 * kGenus + 1, 3, 1, [](int x, int y, int) { return x % 2 == 0 || y != 1; });
}

/// A sheet with 25 holes.
inline SurfaceData Sieve() {
  SurfaceData sheet = shapes::Grid(16, 16), sieve;
  sieve.vertices = sheet.vertices;
  for (std::size_t f = 0; f < sheet.faces.size(); ++f) {
    std::array<double, 2> middle{};
    for (const int v : sheet.faces[f])
      for (std::size_t d = 0; d < 2; ++d)
        middle[d] += 16 * sheet.vertices[static_cast<std::size_t>(v)][d] / 3;
    const auto in_hole = [](double x) { return static_cast<int>(x) % 3 == 1; };
    if (!in_hole(middle[0]) || !in_hole(middle[1])) sieve.faces.push_back(sheet.faces[f]);
  }
  return sieve;
}

/// Figure-8 immersion of the Klein bottle; the orientation of its faces jumps along one line.
inline SurfaceData KleinBottle() {
  constexpr int kAround = 24, kAcross = 12;
  constexpr double kTurn = 6.283185307179586;
  SurfaceData mesh;
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < kAcross; ++j) {
      const double u = kTurn * i / kAround, v = kTurn * j / kAcross;
      const double out = 2 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      mesh.vertices.push_back({out * std::cos(u), out * std::sin(u),
                               std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v)});
    }
  const auto vertex = [&](int i, int j) {
    if (i == kAround) return (2 * kAcross - j) % kAcross;
    return i * kAcross + j % kAcross;
  };
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < kAcross; ++j) {
      mesh.faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return mesh;
}

/// Some faces of a sphere the other way round: each of them with this chance.
inline SurfaceData FlippedSphere(double share) {
  SurfaceData mesh = shapes::Sphere(4);
  std::mt19937 random(7);
  for (auto& face : mesh.faces)
    if (static_cast<double>(random()) < share * 4294967296.0) std::swap(face[0], face[1]);
  return mesh;
}

/// Faces of a cube again, on the same vertices.
inline SurfaceData DoubleFaces(bool other_way) {
  SurfaceData mesh = shapes::Cube(3);
  const auto faces = mesh.faces;
  for (std::size_t f = 0; f < faces.size(); f += 2) {
    mesh.faces.push_back(faces[f]);
    if (other_way) std::swap(mesh.faces.back()[0], mesh.faces.back()[1]);
  }
  return mesh;
}

/// Cones with their tips in one vertex: a vertex with several fans.
inline SurfaceData ConesAtOneTip() {
  SurfaceData mesh;
  mesh.vertices.push_back({0, 0, 0});
  for (int cone = 0; cone < 4; ++cone) {
    const int first = static_cast<int>(mesh.vertices.size());
    for (int k = 0; k < 8; ++k) {
      const double angle = 6.283185307179586 * k / 8, turn = 1.5707963267948966 * cone;
      const double x = 1, y = 0.4 * std::cos(angle), z = 0.4 * std::sin(angle);
      mesh.vertices.push_back(
          {std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y, z});
      mesh.faces.push_back({0, first + k, first + (k + 1) % 8});
    }
  }
  return mesh;
}

inline SurfaceData WithRepeatedVertices() {
  SurfaceData mesh = shapes::Sphere(3);
  mesh.faces.insert(mesh.faces.begin(), {4, 4, 9});
  mesh.faces.insert(mesh.faces.begin() + 20, {2, 7, 2});
  mesh.faces.push_back({5, 5, 5});
  return mesh;
}

/// Vertices moved almost, or quite, onto an edge across: `height` of the edge's length beside it.
inline SurfaceData Needles(double height) {
  SurfaceData mesh = shapes::Sphere(5);
  for (std::size_t f = 0; f < mesh.faces.size(); f += 17) {
    const auto face = mesh.faces[f];
    for (std::size_t d = 0; d < 3; ++d) {
      const double b = mesh.vertices[static_cast<std::size_t>(face[1])][d],
                   c = mesh.vertices[static_cast<std::size_t>(face[2])][d];
      double& a = mesh.vertices[static_cast<std::size_t>(face[0])][d];
      a = b + 0.4 * (c - b) + height * (a - b);
    }
  }
  return mesh;
}

/// Every face has vertices of its own, in the places of its neighbours': nothing hangs together.
inline SurfaceData Unwelded() {
  const SurfaceData whole = shapes::Sphere(3);
  SurfaceData mesh;
  for (const auto& face : whole.faces) {
    for (const int v : face) mesh.vertices.push_back(whole.vertices[static_cast<std::size_t>(v)]);
    const int last = static_cast<int>(mesh.vertices.size()) - 1;
    mesh.faces.push_back({last - 2, last - 1, last});
  }
  return mesh;
}

inline SurfaceData WithUnreferenced() {
  SurfaceData mesh = shapes::Cube(3);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  mesh.vertices.insert(mesh.vertices.end(), {{nan, 0, infinity}, {1e300, -1e300, 0}, {5, 5, 5}});
  return mesh;
}

inline SurfaceData WithCoordinate(double x) {
  SurfaceData mesh = shapes::Cube(3);
  mesh.vertices[10][1] = x;
  return mesh;
}

inline SurfaceData Scaled(double by) {
  SurfaceData mesh = shapes::Torus(10);
  for (auto& p : mesh.vertices)
    for (double& x : p) x *= by;
  return mesh;
}

/// As a float32 file has it: a torus of 3 units that far away has steps of 1/8 or 1/16.
inline SurfaceData FarAway() {
  SurfaceData mesh = shapes::Torus(10);
  for (auto& p : mesh.vertices) p = {static_cast<float>(p[0] + 1e6), static_cast<float>(p[1] - 1e6), p[2]};
  return mesh;
}

inline SurfaceData FirstFaces(std::size_t count) {
  SurfaceData mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  mesh.faces.resize(count);
  return mesh;
}

inline SurfaceData NoArea() {
  SurfaceData mesh = shapes::Grid(3, 3);
  for (auto& p : mesh.vertices) p = {p[0], 2 * p[0], 0};
  return mesh;
}

inline SurfaceData Soup(int count) {
  SurfaceData mesh;
  std::mt19937 random(11);
  const auto real = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int f = 0; f < count; ++f) {
    const std::array<double, 3> at{real(), real(), real()};
    for (int k = 0; k < 3; ++k)
      mesh.vertices.push_back({at[0] + 0.1 * real(), at[1] + 0.1 * real(), at[2] + 0.1 * real()});
    mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return mesh;
}

/// Three spheres, each in the next; the middle one inside out.
inline SurfaceData Shells() {
  SurfaceData mesh;
  for (const double radius : {1.0, 0.8, 0.5}) {
    SurfaceData shell = shapes::Sphere(3);
    for (auto& p : shell.vertices)
      for (double& x : p) x *= radius;
    if (radius == 0.8) shapes::FlipFaces(shell);
    shapes::Append(mesh, shell, {0, 0, 0});
  }
  return mesh;
}

inline SurfaceData ManyComponents() {
  SurfaceData mesh;
  for (int k = 0; k < 4; ++k) {
    shapes::Append(mesh, shapes::Cube(1), {2.0 * k, 0, 0});
    shapes::Append(mesh, shapes::OpenCone(5), {2.0 * k, 2, 0});
    shapes::Append(mesh, shapes::Grid(2, 2), {2.0 * k, 4, 0});
  }
  return mesh;
}

/// What an earlier run, a painter or a scanner left.
inline SurfaceData WithAttributes() {
  SurfaceData mesh = shapes::Torus(8);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    mesh.vertex_quality.push_back(0.1 * static_cast<double>(v % 7));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    mesh.face_quality.push_back(f % 5 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                           : static_cast<double>(f % 11) / 2);
    mesh.wedge_texcoords.push_back({0, 0, 7, -3, 1e30f, 0.5f});
    mesh.wedge_texture_index.push_back(static_cast<std::int16_t>(f % 3));
    mesh.seams.push_back(static_cast<std::uint8_t>(f % 256));
    mesh.corner_colors.push_back({{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}});
  }
  return mesh;
}

}  // namespace corpus

inline const CorpusEntry kCorpus[] = {
    {"components", corpus::ManyComponents},
    {"boundary_loops_26", corpus::Sieve},
    {"genus_0", corpus::Handles<0>},
    {"genus_1", corpus::Handles<1>},
    {"genus_2", corpus::Handles<2>},
    {"genus_5", corpus::Handles<5>},
    {"genus_20", corpus::Handles<20>},
    {"moebius_strip", [] { return shapes::MoebiusStrip(24); }},
    {"klein_bottle", corpus::KleinBottle},
    {"one_face_in_ten_flipped", [] { return corpus::FlippedSphere(0.1); }},
    {"half_the_faces_flipped", [] { return corpus::FlippedSphere(0.5); }},
    {"edges_with_3_faces", [] { return shapes::NonManifoldFin(4); }},
    {"edges_with_4_faces", [] { return corpus::Voxels(2, 2, 2, [](int x, int y, int) { return x == y; }); }},
    {"vertices_with_2_fans", [] { return shapes::BowTie(3); }},
    {"cells_that_share_corners",
     [] { return corpus::Voxels(3, 3, 3, [](int x, int y, int z) { return (x + y + z) % 2 == 0; }); }},
    {"cones_at_one_tip", corpus::ConesAtOneTip},
    {"double_faces", [] { return corpus::DoubleFaces(false); }},
    {"double_faces_the_other_way", [] { return corpus::DoubleFaces(true); }},
    {"repeated_vertices", corpus::WithRepeatedVertices},
    {"zero_area_faces", [] { return corpus::Needles(0); }},
    {"needles", [] { return corpus::Needles(1e-7); }},
    {"coincident_vertices", corpus::Unwelded},
    {"unreferenced_vertices", corpus::WithUnreferenced},
    {"nan", [] { return corpus::WithCoordinate(std::numeric_limits<double>::quiet_NaN()); }, "not a number",
     "not a number"},
    {"infinity", [] { return corpus::WithCoordinate(std::numeric_limits<double>::infinity()); }, "infinite",
     "infinite"},
    {"size_1e-20", [] { return corpus::Scaled(1e-20); }},
    {"size_1e20", [] { return corpus::Scaled(1e20); }},
    {"a_million_units_away", corpus::FarAway},
    {"nothing", [] { return SurfaceData(); }, "empty", "empty"},
    {"no_faces", [] { return corpus::FirstFaces(0); }, "no faces", "no faces"},
    {"one_face", [] { return corpus::FirstFaces(1); }},
    {"two_faces", [] { return corpus::FirstFaces(2); }},
    {"no_area", corpus::NoArea, "no area", "no area"},
    {"soup", [] { return corpus::Soup(60); }},
    {"shells_in_shells", corpus::Shells},
    {"other_attributes", corpus::WithAttributes},
};

}  // namespace dcharts::test
