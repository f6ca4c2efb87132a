// SPDX-License-Identifier: GPL-3.0-or-later
/// Symmetric models get mirrored pairs of pieces, also when their vertices are noisy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "dcharts.h"
#include "pattern/pattern.h"
#include "pattern/surface/base_mesh.h"
#include "pattern/surface/data_coordinates.h"
#include "pattern/surface/join_at_plane.h"
#include "pattern/surface/mirror_plane.h"
#include "pattern/surface/smooth_seams.h"
#include "pattern/surface/symmetric_mesh.h"
#include "shapes.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

// Every vertex off its place by up to 5 % of the mean edge in each direction.
SurfaceData Noisy(SurfaceData mesh) {
  double edge = 0;
  for (const auto& f : mesh.faces) {
    const auto &a = mesh.vertices[f[0]], &b = mesh.vertices[f[1]];
    edge += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / static_cast<double>(mesh.faces.size());
  }
  std::mt19937 random(11);
  std::uniform_real_distribution<double> noise(-0.05 * edge, 0.05 * edge);
  for (auto& v : mesh.vertices)
    for (double& x : v) x += noise(random);
  return mesh;
}

// The disk with one side's rim drawn out: no mirror image across x.
SurfaceData Lopsided(SurfaceData mesh) {
  for (auto& v : mesh.vertices) {
    const double x = v[0], y = v[1];
    v[0] += 0.4 * std::max(0.0, x) * (1 + y);
    v[1] += 0.3 * x * x;
    v[2] += 0.2 * x * y + 0.15 * x * x * x;
  }
  return mesh;
}

TEST(PatternSymmetry, FindsThePlaneOfATeddyAlsoWithNoise) {
  for (const bool noisy : {false, true}) {
    const TestSurface surface(noisy ? Noisy(shapes::Plush(32)) : shapes::Plush(32));
    const auto mirror = FindMirrorPlane(*surface);
    ASSERT_TRUE(mirror.has_value());
    double best = 0;  // the bear stands upright: left and right are along one of the axes
    for (int d = 0; d < 3; ++d) best = std::max(best, std::abs(mirror->normal[d]));
    EXPECT_GT(best, 0.999);
  }
}

TEST(PatternSymmetry, FindsNoneWhereThereIsNone) {
  EXPECT_FALSE(FindMirrorPlane(*TestSurface(Lopsided(shapes::Disk(16)))).has_value());
}

TEST(PatternSymmetry, ASymmetricMeshIsItsOwnImage) {
  const SurfaceData data = Noisy(shapes::Plush(32));
  const TestSurface surface(data);
  const auto mirror = FindMirrorPlane(*surface);
  ASSERT_TRUE(mirror.has_value());
  const SymmetricMesh symmetric = MakeSymmetricMesh(data, *surface, *mirror);
  ASSERT_EQ(symmetric.mesh.faces.size(), 2u * symmetric.halves.half);
  const TestSurface again(symmetric.mesh);
  const auto exact = FindMirrorPlane(*again);
  ASSERT_TRUE(exact.has_value());
  int borders = 0;
  for (int f = 0; f < again->FaceCount(); ++f) {
    const int image = symmetric.halves.ImageOf(f);
    EXPECT_LT((exact->Mirrored(again->Centroid(f)) - again->Centroid(image)).norm(), 1e-9);
    EXPECT_NEAR(again->Area(f), again->Area(image), 1e-12);
    for (int h = 3 * f; h < 3 * f + 3; ++h) borders += again->Opposite(h) < 0;
  }
  EXPECT_EQ(borders, 0);  // closed, as the bear is
}

// The two halves of a symmetric model, a chart each, joined along the plane.
struct JoinedHalves {
  explicit JoinedHalves(const SurfaceData& model) : base(model) {
    base.MakeSymmetric(PatternMaterial::kFabric);
    const MirroredHalves& halves = base.Halves();
    for (int f = 0; f < base.Surface().FaceCount(); ++f) ids.push_back(halves.IsInFirst(f) ? 0 : 1);
    seams = ChartBorders(base.Surface(), ids);
    Params params;
    params.method = FlattenMethod::kConformal;
    Progress progress;
    JoinAtPlane(base.Surface(), halves, params, progress, ids, seams);
  }

  // As a share of the model's longest side; -1 where it isn't symmetric.
  double SeamLength() const {
    double length = 0;
    for (int h = 0; h < base.Surface().HalfEdgeCount(); ++h) {
      if (!IsSeam(seams, h)) continue;
      if (!IsSeam(seams, base.Halves().ImageOfEdge(h))) return -1;
      length += base.Surface().Length(h) / 2 * DataCoordinates(base.Mesh(), base.Surface()).Scale();
    }
    return length / LongestSide(base.Mesh());
  }

  BaseMesh base;
  ChartIds ids;
  SeamMask seams;
};

TEST(PatternSymmetry, ARingThatIsNotFlatStaysOpenAlongThePlane) {
  const SurfaceData frustum = shapes::OpenFrustum(48);  // 2 wide, its side 1.118 long
  const JoinedHalves joined(frustum);
  EXPECT_EQ(ChartCount(joined.ids), 1);
  EXPECT_NEAR(joined.SeamLength(), 1.118 / 2, 0.01);
}

TEST(PatternSymmetry, AFlatRingStaysWhole) {
  const SurfaceData washer = shapes::PlaneWithHole(24);
  const JoinedHalves joined(washer);
  EXPECT_EQ(ChartCount(joined.ids), 1);
  EXPECT_EQ(joined.SeamLength(), 0);
}

TEST(PatternSymmetry, HalvesThatDoNotLieFlatTogetherStayApart) {
  const SurfaceData ball = shapes::Sphere(8);
  const JoinedHalves joined(ball);
  EXPECT_EQ(ChartCount(joined.ids), 2);
}

// Whether the plane x = 0 mirrors the piece's outline on the model onto itself.
bool IsItsOwnImage(const Piece& piece) {
  constexpr double kClose = 3;  // mm
  for (const OutlineLoop& loop : piece.loops)
    for (const OutlinePoint& point : loop) {
      const Point3 image(-point.on_model.x(), point.on_model.y(), point.on_model.z());
      double nearest = kClose;
      for (const OutlineLoop& other : piece.loops)
        for (size_t k = 0; k < other.size(); ++k) {
          const Point3 p = other[k].on_model, along = other[(k + 1) % other.size()].on_model - p;
          const double t = std::clamp((image - p).dot(along) / along.squaredNorm(), 0.0, 1.0);
          nearest = std::min(nearest, (p + t * along - image).norm());
        }
      if (nearest >= kClose) return false;
    }
  return true;
}

struct Bear {
  PatternMaterial material;
  double size;
  bool noisy;
};

class PatternSymmetryOf : public testing::TestWithParam<Bear> {};

TEST_P(PatternSymmetryOf, EveryPieceHasAPartnerOrIsItsOwnImage) {
  const Bear& made = GetParam();
  const SurfaceData exact = shapes::Plush(32), bear = made.noisy ? Noisy(exact) : exact;
  Params params;
  params.material = made.material;
  params.size = made.size;
  params.merge_congruent = true;
  Progress progress;
  const Pattern pattern = MakePattern(bear, params, progress).pattern;
  int mirrored = 0, counted = 0;
  for (const Piece& piece : pattern.pieces) {
    mirrored += piece.mirrored;
    if (piece.drawn) counted += piece.copies + piece.mirror_copies;
    EXPECT_EQ(piece.drawn, piece.group == piece.id);
    int of_group = 0;
    for (const Piece& other : pattern.pieces) of_group += other.group == piece.group;
    EXPECT_TRUE(of_group >= 2 || IsItsOwnImage(piece)) << piece.name << " of " << piece.area << " mm^2";
  }
  EXPECT_GE(mirrored, 1);
  EXPECT_EQ(counted, static_cast<int>(pattern.pieces.size()));
  EXPECT_LT(pattern.largest_ease, made.material == PatternMaterial::kPaper ? 0.001 : 0.01);
  for (int piece : pattern.piece_of_face) EXPECT_GE(piece, 0);
}

INSTANTIATE_TEST_SUITE_P(Meshes, PatternSymmetryOf,
                         testing::Values(Bear{PatternMaterial::kFabric, 300, false},
                                         Bear{PatternMaterial::kFabric, 300, true},
                                         Bear{PatternMaterial::kFabric, 200, true},
                                         Bear{PatternMaterial::kPaper, 300, true}));

TEST(PatternSymmetry, ATextureKeepsTheModelAsItIs) {
  Params params;
  params.size = 300;
  params.print_texture = true;
  Progress progress;
  const SurfaceData torus = shapes::Torus(24);
  const Pattern pattern = MakePattern(torus, params, progress).pattern;
  std::vector<int> seen(torus.faces.size(), 0);
  for (const Piece& piece : pattern.pieces)
    for (int f : piece.flat.face) ++seen[f];
  for (int count : seen) EXPECT_EQ(count, 1);
}

TEST(PatternSmoothSeams, TeethOfACreaseBecomeSmaller) {
  // A roof whose ridge has teeth.
  SurfaceData roof = shapes::Grid(16, 16);
  for (auto& v : roof.vertices) {
    const bool on_ridge = std::abs(v[0] - 0.5) < 1e-9;
    if (on_ridge) v[0] += (static_cast<int>(std::lround(16 * v[1])) % 2 == 0 ? 0.02 : -0.02);
    v[2] = on_ridge ? 0.5 : 0.5 - std::abs(v[0] - 0.5);
  }
  const TestSurface surface(roof);
  const ChartIds ids = surface.Paint([](const std::array<double, 3>& p) { return p[0] < 0.5 ? 0 : 1; });
  const SeamMask seams = ChartBorders(*surface, ids);
  const SurfaceData smooth = WithSmoothSeams(roof, *surface, seams);
  double before = 0, after = 0;
  for (size_t v = 0; v < roof.vertices.size(); ++v) {
    if (std::abs(roof.vertices[v][0] - 0.5) > 0.03) {
      EXPECT_EQ(roof.vertices[v], smooth.vertices[v]);
      continue;
    }
    if (roof.vertices[v][1] < 0.1 || roof.vertices[v][1] > 0.9) continue;
    before = std::max(before, std::abs(roof.vertices[v][0] - 0.5));
    after = std::max(after, std::abs(smooth.vertices[v][0] - 0.5));
  }
  EXPECT_LT(after, 0.5 * before);
}

TEST(PatternSmoothSeams, CornersOfACubeStay) {
  const SurfaceData cube = shapes::Cube(4);
  const TestSurface surface(cube);
  // A side against the others: its border turns at the cube's corners.
  const ChartIds ids = surface.Paint([](const std::array<double, 3>& p) { return p[2] > 0.999 ? 0 : 1; });
  const SurfaceData smooth = WithSmoothSeams(cube, *surface, ChartBorders(*surface, ids));
  for (size_t v = 0; v < cube.vertices.size(); ++v)
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(cube.vertices[v][d], smooth.vertices[v][d], 1e-12);
}

TEST(PatternSmoothSeams, TeethBecomeAStraightLineOnASheet) {
  const SurfaceData grid = shapes::Grid(20, 20);
  const TestSurface surface(grid);
  // The border between the charts goes up in steps of a cell.
  const ChartIds ids = surface.Paint([](const std::array<double, 3>& p) {
    const double x = p[0] + 0.4 * (p[1] - 0.5);
    return std::floor(x * 20) < 10 ? 0 : 1;
  });
  const SeamMask seams = ChartBorders(*surface, ids);
  const SurfaceData smooth = WithSmoothSeams(grid, *surface, seams);
  const TestSurface after(smooth);
  EXPECT_LT(SeamLength(*after, seams), 0.9 * SeamLength(*surface, seams));
  double area = 0;
  for (int f = 0; f < after->FaceCount(); ++f) {
    area += after->Area(f);
    EXPECT_GT(after->Normal(f).z(), 0.99);  // none turned over
  }
  EXPECT_NEAR(area, 1, 1e-9);
  for (size_t v = 0; v < grid.vertices.size(); ++v)
    EXPECT_TRUE(grid.vertices[v][0] > 1e-9 || smooth.vertices[v] == grid.vertices[v]);  // the border stays
}

}  // namespace
}  // namespace dcharts
