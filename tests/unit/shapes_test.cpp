// SPDX-License-Identifier: GPL-3.0-or-later
/// The test shapes are what their table says.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shapes.h"
#include "write_ply.h"

namespace {

using dcharts::SurfaceData;
using dcharts::shapes::AllShapes;
using dcharts::shapes::Shape;
using Edge = std::pair<int, int>;
using Point = std::array<double, 3>;

/// All shapes, made once.
const std::vector<Shape>& Shapes() {
  static const std::vector<Shape> shapes = AllShapes();
  return shapes;
}

Point Minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point Cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double Norm(const Point& a) { return std::sqrt(Dot(a, a)); }

std::array<Point, 3> Corners(const SurfaceData& mesh, size_t f) {
  std::array<Point, 3> corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = mesh.vertices.at(static_cast<size_t>(mesh.faces[f][i]));
  return corners;
}

double Area(const SurfaceData& mesh) {
  double area = 0;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b, c] = Corners(mesh, f);
    area += Norm(Cross(Minus(b, a), Minus(c, a))) / 2;
  }
  return area;
}

/// Positive for a closed surface whose faces look outwards.
double Volume(const SurfaceData& mesh) {
  double volume = 0;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b, c] = Corners(mesh, f);
    volume += Dot(a, Cross(b, c)) / 6;
  }
  return volume;
}

double SmallestAngleInDegrees(const SurfaceData& mesh) {
  double smallest = 180;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = Corners(mesh, f);
    for (size_t i = 0; i < 3; ++i) {
      const Point u = Minus(corners[(i + 1) % 3], corners[i]), v = Minus(corners[(i + 2) % 3], corners[i]);
      smallest = std::min(smallest, std::atan2(Norm(Cross(u, v)), Dot(u, v)) * 57.29577951308232);
    }
  }
  return smallest;
}

struct Edges {
  std::map<Edge, int> directed;    // from the first to the second vertex: number of faces
  std::map<Edge, int> undirected;  // first < second: number of faces
};

Edges EdgesOf(const SurfaceData& mesh) {
  Edges edges;
  for (const auto& f : mesh.faces)
    for (size_t i = 0; i < 3; ++i) {
      const int a = f[i], b = f[(i + 1) % 3];
      ++edges.directed[{a, b}];
      ++edges.undirected[std::minmax(a, b)];
    }
  return edges;
}

/// Number of connected pieces of the graph of these edges.
int Pieces(const std::set<Edge>& edges) {
  std::map<int, int> parent;
  const auto root = [&](int v) {
    parent.try_emplace(v, v);
    while (parent[v] != v) v = parent[v];
    return v;
  };
  for (const auto& [a, b] : edges) {
    const int root_a = root(a), root_b = root(b);
    parent[root_a] = root_b;
  }
  return static_cast<int>(
      std::count_if(parent.begin(), parent.end(), [](const auto& p) { return p.first == p.second; }));
}

std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class ShapesTest : public testing::TestWithParam<size_t> {
 protected:
  const Shape& shape_ = Shapes()[GetParam()];
  const SurfaceData& mesh_ = shape_.mesh;
};

TEST_P(ShapesTest, HasTheTopologyOfItsFacts) {
  const Edges edges = EdgesOf(mesh_);
  std::set<int> used;
  std::set<Edge> all, boundary;
  for (const auto& f : mesh_.faces) used.insert(f.begin(), f.end());
  for (const auto& [edge, faces] : edges.undirected) {
    all.insert(edge);
    if (faces == 1) boundary.insert(edge);
  }
  EXPECT_EQ(used.size(), mesh_.vertices.size()) << "every vertex is used";
  const int euler =
      static_cast<int>(used.size()) - static_cast<int>(all.size()) + static_cast<int>(mesh_.faces.size());
  EXPECT_EQ(euler, shape_.facts.euler);
  EXPECT_EQ(Pieces(all), shape_.facts.components);
  EXPECT_EQ(Pieces(boundary), shape_.facts.boundary_loops);
  if (shape_.facts.manifold && shape_.facts.orientable) {
    EXPECT_EQ(euler, 2 * shape_.facts.components - 2 * shape_.facts.genus - shape_.facts.boundary_loops);
  }
}

TEST_P(ShapesTest, IsOrientedAndManifoldAsItsFactsSay) {
  const Edges edges = EdgesOf(mesh_);
  bool consistent = true;
  for (const auto& [edge, faces] : edges.directed) consistent = consistent && faces == 1;
  EXPECT_EQ(consistent, shape_.facts.orientable && shape_.name != "non_manifold_fin");

  // At a manifold vertex the faces are joined by edges with at most two faces, and two edges at most have one
  // face.
  bool manifold = true;
  std::map<int, int> boundary_edges_at;
  for (const auto& [edge, faces] : edges.undirected) {
    manifold = manifold && faces <= 2;
    if (faces == 1) {
      ++boundary_edges_at[edge.first];
      ++boundary_edges_at[edge.second];
    }
  }
  std::map<int, std::set<Edge>> link;  // the edges opposite to each vertex
  for (const auto& f : mesh_.faces)
    for (size_t i = 0; i < 3; ++i) link[f[i]].insert({f[(i + 1) % 3], f[(i + 2) % 3]});
  for (const auto& [vertex, opposite] : link) manifold = manifold && Pieces(opposite) == 1;
  for (const auto& [vertex, count] : boundary_edges_at) manifold = manifold && count == 2;
  EXPECT_EQ(manifold, shape_.facts.manifold);

  if (shape_.facts.boundary_loops == 0) {
    EXPECT_GT(Volume(mesh_), 0.1) << "faces look outwards";
  }
}

TEST_P(ShapesTest, HasItsArea) {
  EXPECT_NEAR(Area(mesh_) / shape_.facts.area, 1, shape_.facts.area_tolerance);
}

TEST_P(ShapesTest, HasGoodTriangles) {
  // The sides of a pyramid of many sides are pointed.
  const bool pointed = shape_.name == "open_cone" || shape_.name == "closed_cone";
  EXPECT_GT(SmallestAngleInDegrees(mesh_), pointed ? 3 : 15);
}

INSTANTIATE_TEST_SUITE_P(All, ShapesTest, testing::Range<size_t>(0, Shapes().size()),
                         [](const auto& parameter) { return Shapes()[parameter.param].name; });

TEST(Shapes, FollowTheirResolution) {
  using namespace dcharts::shapes;
  EXPECT_EQ(Grid(3, 5).faces.size(), 30u);
  EXPECT_EQ(Cube(4).faces.size(), 6u * 2 * 16);
  EXPECT_EQ(Sphere(3).faces.size(), 20u * 9);
  EXPECT_EQ(Disk(4).faces.size(), 6u * 16);
  EXPECT_GT(CadPart(96).faces.size(), 3 * CadPart(48).faces.size());
  EXPECT_GT(Plush(64).faces.size(), 2 * Plush(40).faces.size());
  EXPECT_NEAR(Area(Sphere(40)), 4 * 3.14159265358979, 0.01);
  EXPECT_NEAR(Area(Torus(96)), 4 * 9.8696044 * 0.4, 0.02);
}

TEST(Shapes, RefuseCountsThatMakeNoShape) {
  using namespace dcharts::shapes;
  EXPECT_THROW(Grid(0, 1), std::invalid_argument);
  EXPECT_THROW(OpenCylinder(2), std::invalid_argument);
  EXPECT_THROW(SphericalCap(5, 4.0), std::invalid_argument);
  EXPECT_THROW(Plush(4), std::invalid_argument);
  EXPECT_THROW(ShapeByName("teapot"), std::invalid_argument);
  EXPECT_THROW(WritePly(Grid(1, 1), "no such folder/grid.ply"), std::runtime_error);
}

/// The .ply files of meshes/ are what the generator makes.
TEST(Shapes, ShippedFilesAreUpToDate) {
  const auto fresh = std::filesystem::temp_directory_path() / "dcharts_shapes_test.ply";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(DCHARTS_MESHES_DIR)) {
    if (entry.path().extension() != ".ply") continue;
    dcharts::shapes::WritePly(dcharts::shapes::ShapeByName(entry.path().stem().string()).mesh,
                              fresh.string());
    EXPECT_TRUE(ReadFile(fresh) == ReadFile(entry.path())) << entry.path() << " differs; run generate_meshes";
    ++files;
  }
  std::filesystem::remove(fresh);
  EXPECT_GE(files, 4);
}

}  // namespace
