// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/coarsen.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "planar/flatten.h"
#include "surface_fixture.h"
#include "thread_count.h"

namespace dcharts {
namespace {

using test::TestSurface;
using Graph = SurfaceGraph<SurfaceMesh>;

bool IsBorder(const Graph& surface, const ChartIds& ids, int h) {
  return surface.Neighbour(h) < 0 || ids[surface.Neighbour(h)] != ids[h / 3];
}

/// What must not change.
struct Topology {
  std::map<int, int> euler, loops;  // per chart
  std::set<std::pair<int, int>> adjacent;
  std::set<int> corners;  // original vertices with three or more borders
  bool operator==(const Topology& other) const {
    return euler == other.euler && loops == other.loops && adjacent == other.adjacent &&
           corners == other.corners;
  }
};

std::ostream& operator<<(std::ostream& out, const Topology& t) {
  for (const auto& e : t.euler) out << "chart " << e.first << ": euler " << e.second << ", ";
  for (const auto& l : t.loops) out << "chart " << l.first << ": loops " << l.second << ", ";
  out << t.adjacent.size() << " pairs, corners";
  for (int v : t.corners) out << ' ' << v;
  return out;
}

Topology TopologyOf(const Graph& surface, const ChartIds& ids, const std::vector<int>& source_vertex = {}) {
  Topology topology;
  const CutVertices cut = OpenAtSeams(surface, ChartBorders(surface, ids));
  std::vector<char> seen(cut.count, 0);
  UnionFind lines(cut.count);
  std::vector<int> chart_of(cut.count, 0);
  std::vector<char> at_border(cut.count, 0);
  std::map<int, int> borders;  // per original vertex
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int id = ids[h / 3], v = cut.of_corner[h], w = cut.of_corner[Next(h)];
    chart_of[v] = id;
    topology.loops.emplace(id, 0);
    if (!seen[v]) ++topology.euler[id];
    seen[v] = 1;
    if (h % 3 == 0) ++topology.euler[id];
    if (IsBorder(surface, ids, h)) {
      --topology.euler[id];
      lines.Join(v, w);
      at_border[v] = at_border[w] = 1;
      if (surface.Opposite(h) < h)
        for (int end : {surface.Vertex(h), surface.Vertex(Next(h))})
          ++borders[source_vertex.empty() ? end : source_vertex[end]];
      if (surface.Neighbour(h) >= 0) topology.adjacent.insert(std::minmax(id, ids[surface.Neighbour(h)]));
    } else if (surface.Opposite(h) > h) {
      --topology.euler[id];
    }
  }
  for (int v = 0; v < cut.count; ++v)
    if (at_border[v] && lines.Find(v) == v) ++topology.loops[chart_of[v]];
  for (const auto& b : borders)
    if (b.second > 2) topology.corners.insert(b.first);
  return topology;
}

struct Coarsened {
  Coarsened(const Graph& surface, const ChartIds& ids, int target)
      : coarse(CoarsenCharts(surface, ids, target)), graph(*coarse.mesh) {}
  CoarseSurface coarse;
  Graph graph;
};

double Quality(const Graph& surface, int f) {
  double squares = 0;
  for (int h = 3 * f; h < 3 * f + 3; ++h) squares += surface.Length(h) * surface.Length(h);
  return squares > 0 ? 4 * std::sqrt(3.0) * surface.Area(f) / squares : 0;
}

void ExpectSound(const Graph& fine, const ChartIds& ids, const Coarsened& result) {
  const CoarseSurface& coarse = result.coarse;
  ASSERT_EQ(static_cast<int>(coarse.ids.size()), result.graph.FaceCount());
  ASSERT_EQ(static_cast<int>(coarse.source_vertex.size()), result.graph.VertexCount());
  for (int v = 0; v < result.graph.VertexCount(); ++v)
    EXPECT_EQ(result.graph.Position(v), fine.Position(coarse.source_vertex[v]));
  EXPECT_EQ(TopologyOf(result.graph, coarse.ids, coarse.source_vertex), TopologyOf(fine, ids));
  std::map<int, int> faces, fine_faces;
  for (int id : ids) ++fine_faces[id];
  for (int id : coarse.ids) ++faces[id];
  for (const auto& chart : fine_faces)
    EXPECT_GE(faces[chart.first], std::min(chart.second, 30)) << "chart " << chart.first;
  // No edge that was not: every border edge joins two vertices of one border line.
  std::set<int> at_border;
  for (int h = 0; h < fine.HalfEdgeCount(); ++h)
    if (IsBorder(fine, ids, h)) at_border.insert({fine.Vertex(h), fine.Vertex(Next(h))});
  for (int h = 0; h < result.graph.HalfEdgeCount(); ++h) {
    if (IsBorder(result.graph, coarse.ids, h)) {
      EXPECT_TRUE(at_border.count(coarse.source_vertex[result.graph.Vertex(h)]));
    }
  }
}

ChartIds Octants(const TestSurface& surface, bool unassigned = false) {
  ChartIds ids = surface.Paint(
      [](const auto& p) { return (p[0] > 0.11 ? 1 : 0) + (p[1] > 0.12 ? 2 : 0) + (p[2] > 0.13 ? 4 : 0); });
  if (unassigned)
    for (int& id : ids) id = id == 0 ? kUnassigned : id;
  else
    SplitAndCompact(*surface, ids);
  return ids;
}

const std::vector<shapes::Shape>& Shapes() {
  static const std::vector<shapes::Shape> kShapes = shapes::AllShapes();
  return kShapes;
}

class CoarsenShape : public testing::TestWithParam<std::string> {};

TEST_P(CoarsenShape, KeepsChartsAndHasNoDegenerateFaces) {
  const auto shape = std::find_if(Shapes().begin(), Shapes().end(),
                                  [](const shapes::Shape& s) { return s.name == GetParam(); });
  const TestSurface surface(shape->mesh);
  double worst = 1;
  for (int f = 0; f < surface->FaceCount(); ++f) worst = std::min(worst, Quality(*surface, f));
  const ChartIds octants = Octants(surface), one(surface->FaceCount(), 0);
  for (const ChartIds& ids : {octants, one, Octants(surface, true)})
    for (int target : {surface->FaceCount() / 4, 1}) {
      const Coarsened result(*surface, ids, target);
      ExpectSound(*surface, ids, result);
      for (int f = 0; f < result.graph.FaceCount(); ++f)
        EXPECT_GE(Quality(result.graph, f), std::min(0.05, worst) * (1 - 1e-9)) << "face " << f;
    }
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  for (const auto& shape : Shapes()) names.push_back(shape.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Shapes, CoarsenShape, testing::ValuesIn(Names()),
                         [](const auto& name) { return name.param; });

TEST(Coarsen, ReachesTheTargetWithLittleLossOfArea) {
  for (const SurfaceData& mesh : {shapes::Sphere(24), shapes::Torus(48), shapes::Plush(80)}) {
    const TestSurface surface(mesh);
    const ChartIds ids = Octants(surface);
    const int target = surface->FaceCount() / 8;
    const Coarsened result(*surface, ids, target);
    ExpectSound(*surface, ids, result);
    EXPECT_LE(result.graph.FaceCount(), target);
    EXPECT_GE(result.graph.FaceCount(), target - 1);
    EXPECT_NEAR(result.graph.TotalArea() / surface->TotalArea(), 1, 0.03);
  }
}

TEST(Coarsen, NothingToDoGivesACopy) {
  const TestSurface surface(shapes::Torus(12));
  const ChartIds ids = Octants(surface);
  for (int target : {surface->FaceCount(), 1 << 30}) {
    const Coarsened result(*surface, ids, target);
    ASSERT_EQ(result.graph.FaceCount(), surface->FaceCount());
    EXPECT_EQ(result.coarse.ids, ids);
    for (int h = 0; h < surface->HalfEdgeCount(); ++h) {
      EXPECT_EQ(result.coarse.source_vertex[result.graph.Vertex(h)], surface->Vertex(h));
      EXPECT_EQ(result.graph.Opposite(h), surface->Opposite(h));
    }
  }
}

TEST(Coarsen, APlaneWithStraightBordersKeepsItsAreasExactly) {
  const TestSurface surface(shapes::Grid(60, 60));
  const ChartIds ids = surface.Paint(
      [](const auto& p) { return static_cast<int>(p[0] * 3) + 3 * static_cast<int>(p[1] * 2); });
  const Coarsened result(*surface, ids, 400);
  ExpectSound(*surface, ids, result);
  EXPECT_LE(result.graph.FaceCount(), 400);
  for (int id = 0; id < 6; ++id) {
    double area = 0;
    for (int f = 0; f < result.graph.FaceCount(); ++f)
      if (result.coarse.ids[f] == id) area += result.graph.Area(f);
    EXPECT_NEAR(area, surface.AreaOf(ids, id), 1e-12);
  }
  EXPECT_NEAR(SeamLength(result.graph, ChartBorders(result.graph, result.coarse.ids)),
              SeamLength(*surface, ChartBorders(*surface, ids)), 1e-12);
}

TEST(Coarsen, BordersKeepTheirShape) {
  const TestSurface surface(shapes::Sphere(32));
  const ChartIds ids = Octants(surface);
  const Coarsened result(*surface, ids, surface->FaceCount() / 12);
  const double before = SeamLength(*surface, ChartBorders(*surface, ids));
  EXPECT_NEAR(SeamLength(result.graph, ChartBorders(result.graph, result.coarse.ids)) / before, 1, 0.03);
  // Every old border vertex is near one of the new border's edges.
  for (int g = 0; g < surface->HalfEdgeCount(); ++g) {
    if (!IsBorder(*surface, ids, g)) continue;
    const Eigen::Vector3d& p = surface->Position(surface->Vertex(g));
    double nearest = 1;
    for (int h = 0; h < result.graph.HalfEdgeCount(); ++h) {
      if (!IsBorder(result.graph, result.coarse.ids, h)) continue;
      const Eigen::Vector3d &a = result.graph.Position(result.graph.Vertex(h)),
                            &b = result.graph.Position(result.graph.Vertex(Next(h)));
      const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (a + t * (b - a) - p).norm());
    }
    EXPECT_LT(nearest, 0.02) << "of a sphere of radius 0.28";
  }
}

TEST(Coarsen, LoopsAndLinesKeepEdges) {
  // A round chart in a plane, and as many faces to be taken out as can be.
  const TestSurface surface(shapes::Grid(40, 40));
  const ChartIds ids =
      surface.Paint([](const auto& p) { return std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.3 ? 1 : 0; });
  const Coarsened result(*surface, ids, 1);
  ExpectSound(*surface, ids, result);
  int loop = 0, rim = 0;
  for (int h = 0; h < result.graph.HalfEdgeCount(); ++h) {
    rim += result.graph.Opposite(h) < 0;
    loop += result.graph.Opposite(h) >= 0 && IsBorder(result.graph, result.coarse.ids, h);
  }
  EXPECT_GE(loop, 2 * 3);
  EXPECT_GE(rim, 4) << "the quality of faces keeps a square from becoming a triangle";
}

TEST(Coarsen, FlattensLikeTheFineSurface) {
  const TestSurface surface(shapes::Sphere(40));
  const ChartIds ids = Octants(surface);
  const Coarsened result(*surface, ids, 1600);
  const SeamMask fine_seams = ChartBorders(*surface, ids),
                 seams = ChartBorders(result.graph, result.coarse.ids);
  PatchExtractor<SurfaceMesh> fine(*surface, fine_seams), coarse(result.graph, seams);
  const auto fine_faces = FacesOfCharts(ids), faces = FacesOfCharts(result.coarse.ids);
  for (size_t c = 0; c < faces.size(); ++c) {
    const Flattening a = Flatten(fine.Extract(fine_faces[c]).mesh),
                     b = Flatten(coarse.Extract(faces[c]).mesh);
    ASSERT_TRUE(a.ok && b.ok);
    EXPECT_GT((b.l2_stretch - 1) / (a.l2_stretch - 1), 0.8) << a.l2_stretch;
    EXPECT_LT((b.l2_stretch - 1) / (a.l2_stretch - 1), 1.4) << a.l2_stretch;
  }
}

TEST(Coarsen, IsDeterministicAndHardlyMindsRotation) {
  SurfaceData mesh = shapes::Plush(60);
  const TestSurface surface(mesh);
  const ChartIds ids = Octants(surface);
  const int target = surface->FaceCount() / 6;
  const CoarseSurface first = CoarsenCharts(*surface, ids, target),
                      second = CoarsenCharts(*surface, ids, target);
  EXPECT_EQ(first.source_vertex, second.source_vertex);
  EXPECT_EQ(first.ids, second.ids);

  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (auto& p : mesh.vertices) {
    const Eigen::Vector3d q = turn * Eigen::Vector3d(p[0], p[1], p[2]) * 37;
    p = {q[0] + 5, q[1], q[2]};
  }
  const TestSurface turned(mesh);
  const CoarseSurface third = CoarsenCharts(*turned, ids, target);
  std::vector<int> common;
  std::set_intersection(first.source_vertex.begin(), first.source_vertex.end(), third.source_vertex.begin(),
                        third.source_vertex.end(), std::back_inserter(common));
  EXPECT_GT(static_cast<double>(common.size()), 0.95 * static_cast<double>(first.source_vertex.size()))
      << "all but ties";
}

// Large enough to be coarsened in blocks.
TEST(Coarsen, ALargeSurfaceComesOutTheSameOnAnyNumberOfThreads) {
  const TestSurface surface(shapes::Sphere(90));
  ASSERT_GT(surface->FaceCount(), 150000);
  const ChartIds ids(surface->FaceCount(), 0);
  for (const int target : {surface->FaceCount() / 4, 2000}) {
    std::vector<CoarseSurface> results;
    for (int count : {1, 3}) {
      const test::Threads threads(count);
      results.push_back(CoarsenCharts(*surface, ids, target));
    }
    EXPECT_EQ(results[0].source_vertex, results[1].source_vertex);
    EXPECT_EQ(results[0].source_face, results[1].source_face);
    EXPECT_EQ(results[0].heir, results[1].heir);
    const Coarsened result(*surface, ids, target);
    EXPECT_LE(result.graph.FaceCount(), target);
    ExpectSound(*surface, ids, result);
  }
}

TEST(Coarsen, FacesWithoutAreaDoNoHarm) {
  SurfaceData mesh = shapes::Grid(24, 24);
  for (size_t v = 0; v < mesh.vertices.size(); v += 7)
    mesh.vertices[v] = mesh.vertices[std::min(v + 1, mesh.vertices.size() - 1)];
  for (size_t v = 300; v < 340; ++v) mesh.vertices[v] = mesh.vertices[300];
  const TestSurface surface(mesh);
  for (const ChartIds& ids : {Octants(surface), ChartIds(surface->FaceCount(), 0)}) {
    const Coarsened result(*surface, ids, 100);
    ExpectSound(*surface, ids, result);
  }
}

TEST(Coarsen, NoFaceTurnsOverBesideCoincidingVertices) {
  // All faces look up, or have no area where rows of vertices coincide.
  SurfaceData mesh = shapes::Grid(24, 24);
  for (auto& p : mesh.vertices)
    if (p[0] > 0.4 && p[0] < 0.6) p[0] = 0.5;
  const TestSurface surface(mesh);
  const ChartIds ids = Octants(surface);
  const Coarsened result(*surface, ids, 100);
  ExpectSound(*surface, ids, result);
  EXPECT_NEAR(result.graph.TotalArea(), surface->TotalArea(), 1e-12);
  for (int f = 0; f < result.graph.FaceCount(); ++f) {
    if (result.graph.Area(f) > 0) {
      EXPECT_GT(result.graph.Normal(f).z(), 0.99);
    }
  }
}

TEST(Coarsen, AnyTangleOfFacesKeepsItsTopology) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const unsigned vertex_count = 6 + random() % 20;
    SurfaceData mesh;
    for (unsigned v = 0; v < vertex_count; ++v)
      mesh.vertices.push_back({random() % 1000 / 1e3, random() % 1000 / 1e3, random() % 1000 / 1e3});
    ChartIds ids;
    for (unsigned f = 0; f < 3 * vertex_count; ++f) {
      const int a = static_cast<int>(random() % vertex_count), b = static_cast<int>(random() % vertex_count),
                c = static_cast<int>(random() % vertex_count);
      if (a == b || b == c || c == a) continue;
      mesh.faces.push_back({a, b, c});
      ids.push_back(static_cast<int>(random() % 2));
    }
    const TestSurface surface(mesh);
    const Coarsened result(*surface, ids, 1);
    ExpectSound(*surface, ids, result);
  }
}

TEST(Coarsen, DamagedSurfacesKeepTheirTopology) {
  // Faces missing, turned over, there twice, and glued to far vertices; ragged charts of many pieces.
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    SurfaceData mesh = seed % 2 ? shapes::Torus(16) : shapes::Sphere(10);
    ChartIds ids;
    const size_t face_count = mesh.faces.size();
    for (unsigned k = 0; k < 12; ++k) {
      auto& face = mesh.faces[random() % face_count];
      const auto copy = face;
      if (k % 4 == 0) face = mesh.faces[random() % face_count];
      if (k % 4 == 1) std::swap(face[0], face[1]);
      if (k % 4 == 2) mesh.faces.push_back(copy);
      if (k % 4 == 3) {
        const int far = static_cast<int>(random() % mesh.vertices.size());
        if (far != face[1] && far != face[2]) face[0] = far;
      }
    }
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& p = mesh.vertices[mesh.faces[f][0]];
      ids.push_back(random() % 50 == 0 ? kUnassigned : (p[0] > 0.1 ? 1 : 0) + (p[2] > 0 ? 2 : 0));
    }
    const TestSurface surface(mesh);
    const Coarsened result(*surface, ids, 200);
    ExpectSound(*surface, ids, result);
    EXPECT_LT(result.graph.FaceCount(), surface->FaceCount());
  }
}

TEST(Coarsen, ManySmallClosedPieces) {
  SurfaceData mesh;
  const SurfaceData piece = shapes::Sphere(2);
  for (int k = 0; k < 20; ++k) {
    const int first = static_cast<int>(mesh.vertices.size());
    for (const auto& p : piece.vertices) mesh.vertices.push_back({p[0] + 3 * k, p[1], p[2]});
    for (const auto& f : piece.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  }
  const TestSurface surface(mesh);
  const ChartIds ids(surface->FaceCount(), 0);  // one id for all: the pieces share its least count of faces
  const Coarsened result(*surface, ids, 1);
  ExpectSound(*surface, ids, result);
  EXPECT_LT(result.graph.FaceCount(), surface->FaceCount());
  EXPECT_GE(result.graph.FaceCount(), 20 * 4) << "a tetrahedron each";
}

}  // namespace
}  // namespace dcharts
