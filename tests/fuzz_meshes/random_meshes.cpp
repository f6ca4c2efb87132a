// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/pi.h"
#include "random_charts.h"

namespace dcharts::fuzz {
namespace {

void AddVertex(SurfaceData& mesh, const Eigen::Vector3d& p) {
  mesh.vertices.push_back({p.x(), p.y(), p.z()});
}

// A grid whose ends are joined: not at all, straight, or with a twist.
enum class Ends { kApart, kStraight, kTwisted };

SurfaceData Strip(Random& random, int faces, std::string& name) {
  const auto rows_joined = random.Chance(0.4);
  const Ends ends = static_cast<Ends>(random.Int(0, 2));
  constexpr const char* kNames[3][2] = {{"sheet", "tube"}, {"ring", "torus"}, {"moebius", "klein"}};
  name = kNames[static_cast<int>(ends)][rows_joined ? 1 : 0];
  const int rows = std::max(rows_joined ? 3 : 1, static_cast<int>(std::sqrt(faces / 4.0)));
  const int columns = std::max(ends == Ends::kApart ? 1 : 3, faces / (2 * rows));
  const int vertex_rows = rows_joined ? rows : rows + 1,
            vertex_columns = ends == Ends::kApart ? columns + 1 : columns;
  const double radius = random.Real(1.5, 4), bump = random.Chance(0.5) ? 0 : random.Real(0, 0.5);
  SurfaceData mesh;
  for (int i = 0; i < vertex_columns; ++i)
    for (int j = 0; j < vertex_rows; ++j) {
      const double x = static_cast<double>(i) / columns, y = static_cast<double>(j) / rows;
      const double around = 2 * kPi * x, turn = ends == Ends::kTwisted ? kPi * x : 0;
      // The profile: a line, or a circle; a Klein bottle's is turned half way round its own axis.
      double u = 2 * y - 1, v = bump * std::sin(5 * x + 3 * y);
      if (rows_joined) {
        u = std::sin(2 * kPi * y);
        v = ends == Ends::kTwisted ? std::sin(4 * kPi * y) / 2 : std::cos(2 * kPi * y);
      }
      const double out = u * std::cos(turn) - v * std::sin(turn),
                   up = u * std::sin(turn) + v * std::cos(turn);
      if (ends == Ends::kApart)
        AddVertex(mesh, {radius * x, out, up});
      else
        AddVertex(mesh, {(radius + out) * std::cos(around), (radius + out) * std::sin(around), up});
    }
  const auto vertex = [&](int i, int j) {
    if (i == vertex_columns) {
      i = 0;
      if (ends == Ends::kTwisted) j = rows_joined ? (rows + rows - j) % rows : rows - j;
    }
    return i * vertex_rows + j % vertex_rows;
  };
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  return mesh;
}

SurfaceData Globe(Random& random, int faces, std::string& name) {
  name = "globe";
  const int rows = std::max(2, static_cast<int>(std::sqrt(faces / 3.0))),
            columns = std::max(3, faces / (2 * rows));
  const bool bottom = random.Chance(0.7);
  SurfaceData mesh;
  const Eigen::Vector3d radii(random.Log(0.05, 3), random.Log(0.3, 3), 1);
  for (int j = 1; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double polar = kPi * j / rows, around = 2 * kPi * i / columns;
      AddVertex(mesh,
                radii.cwiseProduct(Eigen::Vector3d(std::sin(polar) * std::cos(around),
                                                   std::sin(polar) * std::sin(around), std::cos(polar))));
    }
  const int north = static_cast<int>(mesh.vertices.size()), south = north + 1;
  AddVertex(mesh, {0, 0, radii.z()});
  AddVertex(mesh, {0, 0, -radii.z()});
  for (int i = 0; i < columns; ++i) {
    const int next = (i + 1) % columns, last = (rows - 2) * columns;
    mesh.faces.push_back({north, i, next});
    for (int row = 0; row < last; row += columns) {
      mesh.faces.push_back({row + i, row + columns + i, row + columns + next});
      mesh.faces.push_back({row + i, row + columns + next, row + next});
    }
    if (bottom) mesh.faces.push_back({last + i, south, last + next});
  }
  return mesh;
}

// The surface of some cells of a small lattice. Cells that touch in an edge or a corner only make it
// non-manifold there; empty cells inside make shells within shells; the rest may have handles.
SurfaceData Voxels(Random& random, int faces, std::string& name) {
  name = "voxels";
  const int side = std::clamp(static_cast<int>(std::cbrt(faces / 8.0)) + 1, 1, 4);
  const double filled = random.Real(0.2, 0.95);
  std::map<std::array<int, 3>, bool> cells;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) cells[{x, y, z}] = random.Chance(filled);
  cells[{0, 0, 0}] = true;
  SurfaceData mesh;
  std::map<std::array<int, 3>, int> number;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] = number.emplace(at, static_cast<int>(mesh.vertices.size()));
    if (is_new) AddVertex(mesh, Eigen::Vector3d(at[0], at[1], at[2]));
    return place->second;
  };
  for (const auto& [cell, is_filled] : cells) {
    for (int side_of_cell = 0; is_filled && side_of_cell < 6; ++side_of_cell) {
      const std::size_t d = static_cast<std::size_t>(side_of_cell / 2), e = (d + 1) % 3, f = (d + 2) % 3;
      const int up = side_of_cell % 2;
      std::array<int, 3> beyond = cell, a = cell;
      beyond[d] += up ? 1 : -1;
      const auto neighbour = cells.find(beyond);
      if (neighbour != cells.end() && neighbour->second) continue;
      a[d] += up;
      std::array<int, 3> b = a, c = a, g = a;
      ++b[e];
      ++c[e];
      ++c[f];
      ++g[f];
      if (!up) std::swap(b, g);
      mesh.faces.push_back({vertex(a), vertex(b), vertex(c)});
      mesh.faces.push_back({vertex(a), vertex(c), vertex(g)});
    }
  }
  return mesh;
}

SurfaceData Chart(Random& random, int faces, std::string& name) {
  const RandomChart chart = MakeRandomChart(random.Index(1000000000));
  name = NameOf(chart.kind);
  SurfaceData mesh;
  for (Eigen::Index v = 0; v < chart.mesh.positions.rows(); ++v)
    AddVertex(mesh, chart.mesh.positions.row(v).transpose());
  // Not all of a large one: then it has a border somewhere inside, or hangs together in single vertices.
  const Eigen::Index count = std::min<Eigen::Index>(chart.mesh.triangles.rows(), faces);
  for (Eigen::Index t = 0; t < count; ++t)
    mesh.faces.push_back(
        {chart.mesh.triangles(t, 0), chart.mesh.triangles(t, 1), chart.mesh.triangles(t, 2)});
  return mesh;
}

SurfaceData Fan(Random& random, int faces, std::string& name) {
  name = "fan";
  const bool closed = random.Chance(0.5), cone = random.Chance(0.5);
  const int count = std::max(3, std::min(faces, 60));
  const double turns = random.Real(0.2, 3);
  SurfaceData mesh;
  AddVertex(mesh, {0, 0, cone ? random.Real(-3, 3) : 0});
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * kPi * turns * k / count;
    AddVertex(mesh, {std::cos(angle), std::sin(angle), random.Chance(0.1) ? random.Real(-1, 1) : 0});
    if (k > 0) mesh.faces.push_back({0, k, k + 1});
  }
  if (closed) mesh.faces.push_back({0, count, 1});
  return mesh;
}

SurfaceData Soup(Random& random, int faces, std::string& name) {
  name = "soup";
  SurfaceData mesh;
  const double size = random.Log(0.01, 2);
  for (int f = 0; f < faces; ++f) {
    const Eigen::Vector3d at = random.Vector();
    for (int k = 0; k < 3; ++k) AddVertex(mesh, at + size * random.Vector());
    mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return mesh;
}

SurfaceData FewVertices(Random& random, int faces, std::string& name) {
  name = "few vertices";
  SurfaceData mesh;
  const int count = random.Int(3, 14);
  for (int v = 0; v < count; ++v) AddVertex(mesh, random.Vector());
  for (int f = 0; f < std::min(faces, 60); ++f)
    mesh.faces.push_back({random.Int(0, count - 1), random.Int(0, count - 1), random.Int(0, count - 1)});
  return mesh;
}

SurfaceData Hardly(Random& random, int, std::string& name) {
  name = "hardly anything";
  SurfaceData mesh;
  const int vertices = random.Int(0, 4);
  for (int v = 0; v < vertices; ++v) AddVertex(mesh, random.Vector());
  if (vertices >= 3) mesh.faces = {{0, 1, 2}};
  if (vertices >= 4 && random.Chance(0.5)) mesh.faces.push_back({0, 2, 3});
  if (vertices >= 4 && random.Chance(0.3)) mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return mesh;
}

}  // namespace

SurfaceData RandomShape(Random& random, int faces, std::string& name) {
  using Make = SurfaceData (*)(Random&, int, std::string&);
  constexpr Make kMakers[] = {Strip, Strip, Globe, Voxels, Voxels, Chart, Fan, Soup, FewVertices, Hardly};
  return random.Of(kMakers)(random, faces, name);
}

}  // namespace dcharts::fuzz
