// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "common/pi.h"
#include "random.h"

namespace dcharts::fuzz {
namespace {

struct Builder {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<int, 3>> triangles;

  ChartMesh Mesh() const {
    ChartMesh mesh;
    mesh.positions.resize(static_cast<Eigen::Index>(positions.size()), 3);
    mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
      mesh.positions.row(v) = positions[static_cast<std::size_t>(v)].transpose();
    }
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      const auto& corners = triangles[static_cast<std::size_t>(t)];
      mesh.triangles.row(t) << corners[0], corners[1], corners[2];
    }
    return mesh;
  }
};

// A grid over [0,1]^2 with diagonals of random direction; quads that `keep` refuses are left out, and
// `wrapped` joins the last column to the first.
Builder Grid(Random& random, int columns, int rows, const std::function<Eigen::Vector3d(double, double)>& at,
             const std::function<bool(int, int)>& keep, bool wrapped = false) {
  Builder grid;
  const int vertex_columns = wrapped ? columns : columns + 1;
  std::vector<int> number(static_cast<std::size_t>(vertex_columns * (rows + 1)), -1);
  const auto vertex = [&](int i, int j) {
    i %= vertex_columns;
    int& v = number[static_cast<std::size_t>(i * (rows + 1) + j)];
    if (v < 0) {
      v = static_cast<int>(grid.positions.size());
      grid.positions.push_back(at(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
    }
    return v;
  };
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const bool turned = random.Chance(0.5);
      if (!keep(i, j)) continue;
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      if (turned) {
        grid.triangles.push_back({a, b, d});
        grid.triangles.push_back({b, c, d});
      } else {
        grid.triangles.push_back({a, b, c});
        grid.triangles.push_back({a, c, d});
      }
    }
  }
  return grid;
}

bool Everywhere(int, int) { return true; }

// Grows from a triangle: new vertices outside boundary edges, and ears closed between neighbours of a
// boundary vertex. Its shape in space crosses itself as it likes.
Builder Disk(Random& random, int size) {
  Builder disk;
  disk.positions = {{0, 0, 0}, {1, 0, 0}, {0.4, 0.8, 0}};
  disk.triangles = {{0, 1, 2}};
  std::vector<int> border = {0, 1, 2};  // counterclockwise
  std::set<std::pair<int, int>> edges = {{0, 1}, {1, 2}, {0, 2}};
  const double roughness = random.Real(0, 0.6), ears = random.Real(0.2, 0.8);
  while (static_cast<int>(disk.triangles.size()) < size) {
    const int count = static_cast<int>(border.size()), k = random.Int(0, count - 1);
    const int u = border[static_cast<std::size_t>(k)], v = border[static_cast<std::size_t>((k + 1) % count)],
              w = border[static_cast<std::size_t>((k + 2) % count)];
    const std::pair<int, int> closing = std::minmax(u, w);
    if (count > 4 && random.Chance(ears) && edges.count(closing) == 0) {
      disk.triangles.push_back({v, u, w});
      edges.insert(closing);
      border.erase(border.begin() + (k + 1) % count);
      continue;
    }
    const Eigen::Vector3d a = disk.positions[static_cast<std::size_t>(u)],
                          b = disk.positions[static_cast<std::size_t>(v)];
    const double length = std::max((b - a).norm(), 1e-3);
    const Eigen::Vector3d out = Eigen::Vector3d(b.y() - a.y(), a.x() - b.x(), 0) / length;
    const int x = static_cast<int>(disk.positions.size());
    disk.positions.push_back((a + b) / 2 + random.Real(0.3, 0.9) * out +
                             roughness * length * random.Vector());
    disk.triangles.push_back({v, u, x});
    edges.insert(std::minmax(u, x));
    edges.insert(std::minmax(v, x));
    border.insert(border.begin() + k + 1, x);
  }
  return disk;
}

Builder Sheet(Random& random, int size) {
  const int columns = std::max(1, static_cast<int>(std::sqrt(size / 2.0))), rows = columns;
  const double height = random.Chance(0.3) ? 0 : random.Real(0, 0.6), waves = random.Real(1, 6);
  Builder sheet = Grid(
      random, columns, rows,
      [&](double x, double y) -> Eigen::Vector3d {
        return {x, y, height * std::sin(waves * x) * std::cos(waves * y)};
      },
      Everywhere);
  const double noise = random.Real(0, 0.9) / columns;
  for (Eigen::Vector3d& p : sheet.positions) p += noise * random.Vector();
  return sheet;
}

// A strip that turns more than once: it overlaps itself when it is flat, or runs into itself on the way.
Builder Spiral(Random& random, int size) {
  const int rows = random.Int(1, 3), columns = std::max(4, size / (2 * rows));
  const double turns = random.Real(0.5, 4), inner = random.Real(0.2, 1.5), width = random.Real(0.05, 1);
  const double pitch = random.Real(0, 1), growth = random.Real(0, 1);
  return Grid(
      random, columns, rows,
      [&](double x, double y) -> Eigen::Vector3d {
        const double angle = 2 * kPi * turns * x, radius = inner + growth * turns * x + width * (1 - y);
        return {radius * std::cos(angle), radius * std::sin(angle), pitch * turns * x};
      },
      Everywhere);
}

Builder Comb(Random& random, int size) {
  const int teeth = random.Int(2, 12), length = std::max(2, size / (3 * teeth));
  const double bend = random.Real(0, 3), slant = random.Real(-1, 1);
  return Grid(
      random, 2 * teeth - 1, length,
      [&](double x, double y) -> Eigen::Vector3d {
        const double angle = bend * y;
        return {x + slant * y, 3 * std::sin(angle) / std::max(bend, 1e-3),
                3 * (1 - std::cos(angle)) * (x - 0.4)};
      },
      [](int i, int j) { return j == 0 || i % 2 == 0; });
}

// The gap may be far narrower than any edge, or nothing: then the two sides lie on each other.
Builder Cylinder(Random& random, int size) {
  const int rows = random.Int(1, 12), columns = std::max(4, size / (2 * rows));
  const double gap = random.Chance(0.3) ? 0 : random.Log(1e-9, 0.3), length = random.Log(0.05, 20);
  const double taper = random.Chance(0.5) ? 0 : random.Real(0, 1),
               swell = random.Chance(0.5) ? 0 : random.Real(-0.5, 1);
  return Grid(
      random, columns, rows,
      [&](double x, double y) -> Eigen::Vector3d {
        const double angle = 2 * kPi * (1 - gap) * x;
        const double radius = 1.001 - taper * y + swell * std::sin(kPi * y);
        return {radius * std::cos(angle), radius * std::sin(angle), length * y};
      },
      Everywhere);
}

// A tube, or a sheet with holes.
Builder Loops(Random& random, int size) {
  if (random.Chance(0.4)) {
    const int columns = random.Int(3, 20), rows = std::max(1, size / (2 * columns));
    const double length = random.Log(0.05, 10), taper = random.Real(-1, 0.99);
    return Grid(
        random, columns, rows,
        [&](double x, double y) -> Eigen::Vector3d {
          const double radius = 1 - taper * y;
          return {radius * std::cos(2 * kPi * x), radius * std::sin(2 * kPi * x), length * y};
        },
        Everywhere, true);
  }
  const int side = std::max(3, static_cast<int>(std::sqrt(size / 2.0)));
  const double height = random.Real(0, 0.5);
  return Grid(
      random, side, side,
      [&](double x, double y) -> Eigen::Vector3d {
        return {x, y, height * std::sin(5 * x) * std::sin(4 * y)};
      },
      [&](int i, int j) {
        const bool hole = i % 4 == 1 && j % 4 == 1 && i + 1 < side && j + 1 < side;
        return !hole;
      });
}

// A tube with a closed end, or a sphere with a small hole.
Builder Finger(Random& random, int size) {
  const int columns = random.Int(3, 12), rows = std::max(2, size / (2 * columns));
  const double length = random.Log(0.3, 20), opening = random.Real(0.1, 3);
  const bool sphere = random.Chance(0.5);
  Builder finger = Grid(
      random, columns, rows,
      [&](double x, double y) -> Eigen::Vector3d {
        const double angle = 2 * kPi * x, polar = opening * (1 - y) + 0.05;
        const double radius = sphere ? std::sin(polar) : 1;
        return {radius * std::cos(angle), radius * std::sin(angle), sphere ? std::cos(polar) : length * y};
      },
      Everywhere, true);
  // The last ring's vertices are those with y = 1: fans around a tip.
  std::set<std::pair<int, int>> directed;
  for (const auto& t : finger.triangles) {
    for (std::size_t k = 0; k < 3; ++k) directed.insert({t[k], t[(k + 1) % 3]});
  }
  const double top = sphere ? std::cos(0.05) : length;
  Eigen::Vector3d tip(0, 0, sphere ? 1 : length + 0.3);
  const int tip_vertex = static_cast<int>(finger.positions.size());
  for (const auto& [a, b] : directed) {
    const bool at_top = std::abs(finger.positions[static_cast<std::size_t>(a)].z() - top) < 1e-9 &&
                        std::abs(finger.positions[static_cast<std::size_t>(b)].z() - top) < 1e-9;
    if (at_top && directed.count({b, a}) == 0) finger.triangles.push_back({b, a, tip_vertex});
  }
  finger.positions.push_back(tip);
  return finger;
}

// Moves corners of some triangles almost, or quite, onto the opposite edge or the next corner.
void AddSlivers(Random& random, Builder& chart) {
  if (random.Chance(0.3)) return;
  const double share = random.Log(1e-3, 0.5);
  for (const auto& t : chart.triangles) {
    if (!random.Chance(share)) continue;
    const std::size_t k = static_cast<std::size_t>(random.Int(0, 2));
    const auto at = [&](std::size_t i) -> Eigen::Vector3d& {
      return chart.positions[static_cast<std::size_t>(t[(k + i) % 3])];
    };
    const double along = random.Chance(0.2) ? 0 : random.Real(0, 1);
    const double height = random.Chance(0.1) ? 0 : random.Log(1e-9, 1e-2);
    at(0) = at(1) + along * (at(2) - at(1)) + height * random.Vector();
  }
}

}  // namespace

const char* NameOf(ChartKind kind) {
  constexpr const char* kNames[kChartKinds] = {"disks",     "sheets",        "spirals", "combs",
                                               "cylinders", "several loops", "fingers"};
  return kNames[static_cast<int>(kind)];
}

RandomChart MakeRandomChart(std::uint64_t seed) {
  using Make = Builder (*)(Random&, int);
  constexpr Make kMakers[kChartKinds] = {Disk, Sheet, Spiral, Comb, Cylinder, Loops, Finger};
  Random random(seed);
  RandomChart chart;
  const int kind = random.Int(0, kChartKinds - 1);
  chart.kind = static_cast<ChartKind>(kind);
  const int size = static_cast<int>(random.Log(1, 1000));
  Builder builder = kMakers[kind](random, size);
  AddSlivers(random, builder);
  chart.mesh = builder.Mesh();
  chart.mesh.positions *= random.Log(1e-6, 1e6);
  return chart;
}

}  // namespace dcharts::fuzz
