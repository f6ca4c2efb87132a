// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/pi.h"
#include "planar/flatten.h"
#include "surface/patch_paths.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

struct CutResult {
  ChartIds ids;
  SeamMask seams;
  int darts = 0;
};

CutResult CutOne(const TestSurface& surface, const Params& params = {}) {
  CutResult result;
  result.ids.assign(surface->FaceCount(), 0);
  SplitAndCompact(*surface, result.ids);
  Progress progress;
  KnownFlattenings known;
  result.darts = ChartCutter<SurfaceMesh>(*surface, params, progress)
                     .Run(ChartsFor::kPattern, result.ids, result.seams, known);
  return result;
}

Params Disks() {
  Params params;
  params.cut_to_disk = true;
  return params;
}
// Only the cuts that no chart can do without.
Params NoDarts() {
  Params params;
  params.max_dart_percent = 0;
  params.max_stretch = 0;
  return params;
}
// Darts as in the paper.
Params ByFittingError() {
  Params params;
  params.dart_by = DartMethod::kFittingError;
  return params;
}

std::vector<ChartPatch> Patches(const TestSurface& surface, const CutResult& result) {
  std::vector<ChartPatch> patches;
  for (int c = 0; c < ChartCount(result.ids); ++c)
    patches.push_back(surface.Patch(result.ids, result.seams, c));
  return patches;
}

int GenusOf(const ChartPatch& patch) {
  return (2 - static_cast<int>(LoopsOf(patch).size()) - EulerCharacteristic(patch)) / 2;
}

// Length of the cuts in input units, and the edges' ends.
double CutLength(const TestSurface& surface, const CutResult& result) {
  return SeamLength(*surface, result.seams) / surface.Scale();
}
std::vector<std::array<int, 2>> CutEdges(const TestSurface& surface, const CutResult& result) {
  std::vector<std::array<int, 2>> edges;
  for (int h = 0; h < surface->HalfEdgeCount(); ++h)
    if (surface->Opposite(h) > h && IsSeam(result.seams, h))
      edges.push_back({surface->Vertex(h), surface->Vertex(Next(h))});
  return edges;
}

// Both sides of every edge agree, borders of the mesh are no seams.
void ExpectWellFormed(const TestSurface& surface, const CutResult& result) {
  for (int h = 0; h < surface->HalfEdgeCount(); ++h) {
    if (surface->Opposite(h) < 0)
      EXPECT_FALSE(IsSeam(result.seams, h));
    else
      EXPECT_EQ(IsSeam(result.seams, h), IsSeam(result.seams, surface->Opposite(h)));
  }
  EXPECT_TRUE(SeamsAgree(*surface, result.ids, result.seams));
}

TEST(Cut, TorusIsOpened) {
  for (const SurfaceData& mesh : {shapes::Torus(8), shapes::Torus(16)}) {
    const TestSurface surface(mesh);
    const CutResult result = CutOne(surface, NoDarts());
    ExpectWellFormed(surface, result);
    ASSERT_EQ(ChartCount(result.ids), 1);
    const ChartPatch patch = Patches(surface, result)[0];
    EXPECT_EQ(EulerCharacteristic(patch), 1);
    EXPECT_EQ(LoopsOf(patch).size(), 1u);
    // A loop around the tube and one around the hole, not much longer than the shortest there are: an edge
    // path may be half as long again as a straight line.
    const double shortest = 2 * kPi * 0.4 + 2 * kPi * 0.6;
    EXPECT_GT(CutLength(surface, result), 0.9 * shortest);
    EXPECT_LT(CutLength(surface, result), 1.8 * shortest);
  }
}

TEST(Cut, DoubleTorusIsOpened) {
  const TestSurface surface(shapes::DoubleTorus(32));
  const CutResult result = CutOne(surface, NoDarts());
  ExpectWellFormed(surface, result);
  for (const ChartPatch& patch : Patches(surface, result)) {
    EXPECT_EQ(GenusOf(patch), 0);
    EXPECT_GE(LoopsOf(patch).size(), 1u);
  }
}

TEST(Cut, HandlesWithBoundariesAreOpened) {
  // A torus with some faces taken out, here and there.
  SurfaceData mesh = shapes::Torus(12);
  mesh.faces.erase(mesh.faces.begin() + 300, mesh.faces.begin() + 304);
  mesh.faces.erase(mesh.faces.begin() + 100, mesh.faces.begin() + 103);
  mesh.faces.erase(mesh.faces.begin());
  const TestSurface surface(mesh);
  for (bool to_disk : {false, true}) {
    Params params = NoDarts();
    params.cut_to_disk = to_disk;
    const CutResult result = CutOne(surface, params);
    ExpectWellFormed(surface, result);
    for (const ChartPatch& patch : Patches(surface, result)) {
      EXPECT_EQ(GenusOf(patch), 0);
      if (to_disk) {
        EXPECT_EQ(LoopsOf(patch).size(), 1u);
      } else {
        EXPECT_GE(LoopsOf(patch).size(), 1u);
      }
    }
  }
}

TEST(Cut, EveryShapeInOneChartBecomesFlat) {
  for (const SurfaceData& mesh :
       {shapes::CadPart(24), shapes::MoebiusStrip(24), shapes::Plush(32), shapes::TwoComponents(3),
        shapes::NonManifoldFin(4), shapes::BowTie(3), shapes::ClosedCylinder(12), shapes::Cube(1)}) {
    const TestSurface surface(mesh);
    for (Params params : {Params(), ByFittingError()})
      for (bool to_disk : {false, true}) {
        params.cut_to_disk = to_disk;
        const CutResult result = CutOne(surface, params);
        ExpectWellFormed(surface, result);
        for (const ChartPatch& patch : Patches(surface, result)) {
          EXPECT_EQ(GenusOf(patch), 0);
          EXPECT_GE(LoopsOf(patch).size(), 1u);
          if (to_disk) {
            EXPECT_EQ(LoopsOf(patch).size(), 1u);
          }
        }
      }
  }
}

TEST(Cut, SphereGetsASlit) {
  for (int n : {1, 2, 8}) {
    const TestSurface surface(shapes::Sphere(n));
    const CutResult result = CutOne(surface, NoDarts());
    ExpectWellFormed(surface, result);
    const ChartPatch patch = Patches(surface, result)[0];
    EXPECT_EQ(EulerCharacteristic(patch), 1);
    EXPECT_EQ(LoopsOf(patch).size(), 1u);
    // A path: no closed loops, about from pole to pole.
    EXPECT_GT(CutLength(surface, result), 1.5);
    EXPECT_LT(CutLength(surface, result), 1.3 * kPi);
  }
}

TEST(Cut, TwoFacesBackToBackGetASlit) {
  SurfaceData mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 1}};
  const TestSurface surface(mesh);
  const CutResult result = CutOne(surface);
  ExpectWellFormed(surface, result);
  const ChartPatch patch = Patches(surface, result)[0];
  EXPECT_EQ(EulerCharacteristic(patch), 1);
  EXPECT_EQ(CutEdges(surface, result).size(), 2u);
}

TEST(Cut, OpenCylinderIsCutOnceAlongItsAxis) {
  const TestSurface surface(shapes::OpenCylinder(24));
  for (bool to_disk : {false, true}) {
    Params params;
    params.cut_to_disk = to_disk;
    const CutResult result = CutOne(surface, params);
    ExpectWellFormed(surface, result);
    EXPECT_EQ(EulerCharacteristic(Patches(surface, result)[0]), 1);
    EXPECT_NEAR(CutLength(surface, result), 1, 1e-9);
    EXPECT_EQ(result.darts, 0);
  }
}

TEST(Cut, FrustumIsCutOnce) {
  const TestSurface surface(shapes::OpenFrustum(24));
  const CutResult result = CutOne(surface);
  EXPECT_EQ(EulerCharacteristic(Patches(surface, result)[0]), 1);
  EXPECT_NEAR(CutLength(surface, result), std::sqrt(1.25), 0.01);
}

TEST(Cut, HoleInAPlaneStaysUnlessADiskIsAskedFor) {
  const TestSurface surface(shapes::PlaneWithHole(16));
  CutResult result = CutOne(surface);
  EXPECT_TRUE(CutEdges(surface, result).empty());
  result = CutOne(surface, Disks());
  ExpectWellFormed(surface, result);
  EXPECT_EQ(EulerCharacteristic(Patches(surface, result)[0]), 1);
  // From the hole's rim to the nearest side.
  EXPECT_LT(CutLength(surface, result), 0.25 * 1.25);
  EXPECT_GE(CutLength(surface, result), 0.25 - 1e-9);
}

TEST(Cut, SeveralHolesAreJoinedByTheShortestCuts) {
  // A sheet with 3 by 3 quads missing here and there.
  const int n = 24;
  SurfaceData mesh = shapes::Grid(n, n);
  std::vector<std::array<int, 3>> faces;
  for (const auto& face : mesh.faces) {
    double x = 0, y = 0;
    for (int v : face) {
      x += mesh.vertices[v][0] / 3 * n;
      y += mesh.vertices[v][1] / 3 * n;
    }
    auto within = [&](int i, int j) { return x > i && x < i + 3 && y > j && y < j + 3; };
    if (!within(3, 10) && !within(10, 10) && !within(12, 16)) faces.push_back(face);
  }
  mesh.faces = faces;
  const TestSurface surface(mesh);
  EXPECT_TRUE(CutEdges(surface, CutOne(surface)).empty());
  const CutResult result = CutOne(surface, Disks());
  EXPECT_EQ(EulerCharacteristic(Patches(surface, result)[0]), 1);
  // 3 quads to the left side, 4 between the first two holes, 3 between the second and the third.
  EXPECT_NEAR(CutLength(surface, result), 10.0 / n, 1e-9);
}

TEST(Cut, OpenConeGetsOneDartToItsApex) {
  const TestSurface surface(shapes::OpenCone(24));
  for (DartMethod method : {DartMethod::kFittingError, DartMethod::kMeasuredStretch}) {
    Params params;
    params.dart_by = method;
    params.max_dart_percent = 1000;
    const CutResult result = CutOne(surface, params);
    ExpectWellFormed(surface, result);
    EXPECT_EQ(result.darts, 1);
    EXPECT_EQ(EulerCharacteristic(Patches(surface, result)[0]), 1);
    EXPECT_NEAR(CutLength(surface, result), std::sqrt(1.25), 0.01);
    std::set<int> ends;
    for (const auto& edge : CutEdges(surface, result)) ends.insert(edge.begin(), edge.end());
    EXPECT_TRUE(std::any_of(ends.begin(), ends.end(), [&](int v) {
      return surface.InputPosition(v)[2] > 1 - 1e-9;
    })) << "the apex";
  }
}

TEST(Cut, DefaultsReachAConesApex) {
  const TestSurface surface(shapes::OpenCone());
  EXPECT_EQ(CutOne(surface).darts, 1);
  EXPECT_EQ(CutOne(surface, ByFittingError()).darts, 1);
}

TEST(Cut, DartsOfASphericalCap) {
  const TestSurface surface(shapes::SphericalCap(12, 1.5));
  Params params = ByFittingError();
  params.dart_fitting_error = 0.05;
  const CutResult result = CutOne(surface, params);
  ExpectWellFormed(surface, result);
  EXPECT_GE(result.darts, 1);
  const ChartPatch patch = Patches(surface, result)[0];
  EXPECT_EQ(EulerCharacteristic(patch), 1) << "darts open nothing else";
  EXPECT_EQ(LoopsOf(patch).size(), 1u);
  // Each dart is a path from the rim: it starts on the border, so every piece of cut touches it.
  EXPECT_GT(CutLength(surface, result), 0);
}

TEST(Cut, NoDartsBelowTheErrorOrWithoutLength) {
  const TestSurface surface(shapes::SphericalCap(12, 1.0));
  Params params = ByFittingError();
  params.dart_fitting_error = 4;
  EXPECT_EQ(CutOne(surface, params).darts, 0);
  params.dart_fitting_error = 0;
  params.max_dart_percent = 0;
  EXPECT_EQ(CutOne(surface, params).darts, 0);
  EXPECT_TRUE(CutEdges(surface, CutOne(surface, params)).empty());
}

TEST(Cut, DartsAreNoLongerThanAllowed) {
  const TestSurface surface(shapes::SphericalCap(12, 1.5));
  double last = 0;
  for (double percent : {5.0, 20.0, 60.0, 1000.0}) {
    Params params = ByFittingError();
    params.dart_fitting_error = 0;
    params.max_dart_percent = percent;
    const CutResult result = CutOne(surface, params);
    // Each is at most this share of the size of the chart (its bounding box's diagonal).
    double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
    for (int v = 0; v < surface->VertexCount(); ++v)
      for (int d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], surface.InputPosition(v)[d]);
        high[d] = std::max(high[d], surface.InputPosition(v)[d]);
      }
    const double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    EXPECT_LE(CutLength(surface, result), result.darts * size * percent / 100 + 1e-9) << percent;
    last = std::max(last, CutLength(surface, result));
  }
  EXPECT_GT(last, 0);
}

TEST(Cut, FlatAndDevelopableChartsGetNoDarts) {
  for (const SurfaceData& mesh : {shapes::Grid(10, 10), shapes::Disk(8), shapes::OpenCylinder(24)})
    for (const Params& params : {Params(), ByFittingError()})
      EXPECT_EQ(CutOne(TestSurface(mesh), params).darts, 0);
}

TEST(Cut, ChartsKeepWithinMaxStretchWhateverDartsGoBy) {
  const TestSurface surface(shapes::SphericalCap(16, 2));
  for (DartMethod method : {DartMethod::kFittingError, DartMethod::kMeasuredStretch})
    for (double longest : {0.0, 100.0}) {
      Params params;
      params.dart_by = method;
      params.max_dart_percent = longest;
      params.max_stretch = 1.005;
      const CutResult result = CutOne(surface, params);
      ExpectWellFormed(surface, result);
      for (const ChartPatch& patch : Patches(surface, result))
        EXPECT_LE(Flatten(patch.mesh).l2_stretch, 1.005 + 1e-4);
      if (longest == 0) {
        EXPECT_EQ(result.darts, 0);
        EXPECT_GT(ChartCount(result.ids), 1);
      }
      params.max_stretch = 0;
      EXPECT_EQ(ChartCount(CutOne(surface, params).ids), 1);
      params.max_stretch = 1.005;
      params.target_charts = 1;
      EXPECT_EQ(ChartCount(CutOne(surface, params).ids), 1);
    }
}

TEST(Cut, DartsLowerAMeanStretchAboveHalfwayToTheBound) {
  const TestSurface surface(shapes::SphericalCap(16, 1.2));
  const auto lowered = [&](const Params& params, CutResult& result) {
    KnownFlattenings known;
    Progress progress;
    result.ids.assign(surface->FaceCount(), 0);
    ChartCutter<SurfaceMesh> cutter(*surface, params, progress);
    EXPECT_EQ(cutter.Run(ChartsFor::kPattern, result.ids, result.seams, known), 0);
    const double before = known.Find(Patches(surface, result)[0])->l2_stretch;
    result.darts = cutter.Run(ChartsFor::kAtlas, result.ids, result.seams, known);
    ExpectWellFormed(surface, result);
    EXPECT_EQ(ChartCount(result.ids), 1);
    const Flattening* flat = known.Find(Patches(surface, result)[0]);
    EXPECT_TRUE(flat) << "Parameterize needn't flatten it again";
    EXPECT_GT(before, 1.005);
    return flat ? flat->l2_stretch : 0;
  };
  Params params;
  CutResult result;
  EXPECT_LE(lowered(params, result), 1.005);
  EXPECT_EQ(result.darts, 1);
  params.max_stretch = 1.02;
  lowered(params, result);
  EXPECT_EQ(result.darts, 0) << "below halfway already";
  params = Params();
  params.max_dart_percent = 0;
  lowered(params, result);
  EXPECT_EQ(result.darts, 0);
  params = Params();
  params.target_charts = 1;
  lowered(params, result);
  EXPECT_EQ(result.darts, 0);
}

TEST(Cut, BordersBetweenChartsAreSeams) {
  const TestSurface surface(shapes::Cube(4));
  CutResult result;
  result.ids = surface.Paint([](const auto& p) { return test::CubeSide(p, {0.5, 0.5, 0.5}, 0.5); });
  const ChartIds before = result.ids;
  Progress progress;
  KnownFlattenings known;
  result.darts = ChartCutter<SurfaceMesh>(*surface, Params(), progress)
                     .Run(ChartsFor::kPattern, result.ids, result.seams, known);
  EXPECT_EQ(result.ids, before);
  EXPECT_EQ(result.darts, 0);
  EXPECT_EQ(result.seams, ChartBorders(*surface, before));
  EXPECT_NEAR(CutLength(surface, result), 12, 1e-9);
}

// --- the parts cuts are made of

TEST(PatchPaths, ShortestPathsAlongEdges) {
  const TestSurface surface(shapes::Grid(6, 6));
  const ChartPatch patch = surface.WholePatch();
  PatchPaths paths(patch);
  int corner = 0;
  for (int v = 0; v < patch.VertexCount(); ++v)
    if (patch.mesh.positions.row(v).sum() < patch.mesh.positions.row(corner).sum()) corner = v;
  paths.Run({corner}, false);
  for (int v = 0; v < patch.VertexCount(); ++v) {
    const double line = (patch.mesh.positions.row(v) - patch.mesh.positions.row(corner)).norm();
    EXPECT_GE(paths.Distance(v), line - 1e-12);
    double length = 0;
    for (int h : paths.Path(v)) length += patch.Length(h);
    EXPECT_NEAR(length, paths.Distance(v), 1e-12);
    EXPECT_EQ(paths.Source(v), 0);
  }
  EXPECT_EQ(paths.Path(corner).size(), 0u);
}

TEST(PatchPaths, InsideOnlyKeepsOffTheBoundary) {
  const TestSurface surface(shapes::Grid(6, 6));
  const ChartPatch patch = surface.WholePatch();
  PatchPaths paths(patch);
  int middle = -1, boundary = 0;
  for (int v = 0; v < patch.VertexCount(); ++v) {
    if (patch.mesh.positions.row(v).norm() < 1e-9) middle = v;
    boundary += paths.OnBoundary(v);
  }
  ASSERT_GE(middle, 0);
  EXPECT_EQ(boundary, 24);
  paths.Run({middle}, true);
  for (int v = 0; v < patch.VertexCount(); ++v) {
    if (paths.Distance(v) == PatchPaths::kFar) continue;  // a corner that only boundary edges lead to
    for (int w = v; paths.From(w) >= 0; w = paths.Before(w)) {
      EXPECT_GE(patch.opposite[paths.From(w)], 0);
      if (w != v) {
        EXPECT_FALSE(paths.OnBoundary(w));
      }
    }
  }
}

TEST(Loops, EulerCharacteristicsOfKnownShapes) {
  auto euler = [](const SurfaceData& mesh) { return EulerCharacteristic(TestSurface(mesh).WholePatch()); };
  auto loops = [](const SurfaceData& mesh) { return LoopsOf(TestSurface(mesh).WholePatch()).size(); };
  EXPECT_EQ(euler(shapes::Grid(4, 4)), 1);
  EXPECT_EQ(loops(shapes::Grid(4, 4)), 1u);
  EXPECT_EQ(euler(shapes::PlaneWithHole(8)), 0);
  EXPECT_EQ(loops(shapes::PlaneWithHole(8)), 2u);
  EXPECT_EQ(euler(shapes::Sphere(3)), 2);
  EXPECT_EQ(loops(shapes::Sphere(3)), 0u);
  EXPECT_EQ(euler(shapes::Torus(8)), 0);
  EXPECT_EQ(euler(shapes::DoubleTorus(32)), -2);
}

TEST(AngleSums, AddUp) {
  // Gauss-Bonnet: 2 pi V - sum of all angles = 2 pi chi for a closed surface.
  for (const auto& [mesh, chi] : {std::pair<SurfaceData, int>{shapes::Sphere(5), 2}, {shapes::Torus(8), 0}}) {
    const std::vector<double> sums = AngleSums(TestSurface(mesh).WholePatch());
    double defect = 0;
    for (double s : sums) defect += 2 * kPi - s;
    EXPECT_NEAR(defect, 2 * kPi * chi, 1e-9);
  }
  for (double s : AngleSums(TestSurface(shapes::Cube(1)).WholePatch())) EXPECT_NEAR(s, 1.5 * kPi, 1e-12);
}

}  // namespace
}  // namespace dcharts
