// SPDX-License-Identifier: GPL-3.0-or-later
/// The result belongs to the shape: not to where it stands, how large it is, or how its faces are numbered.
#include "dcharts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "noisy.h"
#include "shapes.h"

namespace dcharts {
namespace {

// No two faces alike, so that no ties are left to the numbering (a regular shape has many: seeds equally far,
// faces of equal cost; their order decides, and another order gives another result as good).
SurfaceData Irregular(SurfaceData mesh) {
  std::mt19937 random(77);
  std::uniform_real_distribution<double> jitter(-0.004, 0.004);
  for (auto& p : mesh.vertices) {
    const double x = p[0], y = p[1], z = p[2];
    p = {x + 0.1 * std::sin(3 * y + 1) + jitter(random),
         1.2 * y + 0.08 * std::cos(2 * z + x) + jitter(random), 0.9 * z + 0.07 * x * y + jitter(random)};
  }
  return mesh;
}

std::vector<SurfaceData> Meshes() {
  return {Irregular(shapes::Sphere(7)), Irregular(shapes::Torus(12)), Irregular(shapes::SaddleRidge(16)),
          Irregular(shapes::TwoComponents(4))};
}

struct Outcome {
  std::vector<double> areas;  // of the charts, as shares of the surface, sorted
  double seam_length;
  int darts;
};

using Stages = std::vector<SurfaceChange (*)(const SurfaceData&, const Params&, Progress&)>;
const Stages kAllButFlattening{Segment, Fill, Straighten, Merge, Cut};

Outcome OutcomeOf(SurfaceData mesh, int count, const Stages& stages) {
  Params params;
  params.chart_count = count;
  Progress progress;
  SurfaceChange change;
  for (auto stage : stages) {
    change = stage(mesh, params, progress);
    mesh.face_quality.assign(change.chart_ids.begin(), change.chart_ids.end());
  }
  Outcome outcome;
  outcome.areas.assign(*change.report.charts, 0);
  const double total = test::TotalArea(mesh);
  for (size_t f = 0; f < mesh.faces.size(); ++f)
    outcome.areas[change.chart_ids[f]] += test::FaceArea(mesh, f) / total;
  std::sort(outcome.areas.begin(), outcome.areas.end());
  outcome.seam_length = *change.report.seam_length;
  outcome.darts = change.report.darts.value_or(0);
  return outcome;
}

// Every face in four at the middles of its edges: the same surface.
SurfaceData Quartered(const SurfaceData& mesh) {
  SurfaceData fine;
  fine.vertices = mesh.vertices;
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(fine.vertices.size()));
    if (!is_new) return at->second;
    const auto &p = mesh.vertices[a], &q = mesh.vertices[b];
    fine.vertices.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.faces) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.faces.insert(fine.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}});
  }
  return fine;
}

SurfaceChange Atlas(const SurfaceData& mesh, int count) {
  Params params;
  params.chart_count = count;
  Progress progress;
  return TextureAtlas(mesh, params, progress);
}

void ExpectAlike(const SurfaceData& changed, const SurfaceData& mesh, int count, double tolerance,
                 const Stages& stages) {
  const Outcome a = OutcomeOf(mesh, count, stages), b = OutcomeOf(changed, count, stages);
  ASSERT_EQ(a.areas.size(), b.areas.size());
  for (size_t c = 0; c < a.areas.size(); ++c) EXPECT_NEAR(a.areas[c], b.areas[c], tolerance) << c;
  EXPECT_EQ(a.darts, b.darts);
  EXPECT_NEAR(a.seam_length, b.seam_length, tolerance * 100);
}

void ForAll(double tolerance, const std::function<void(SurfaceData&)>& change,
            const Stages& stages = kAllButFlattening) {
  int k = 0;
  for (const SurfaceData& mesh : Meshes())
    for (int count : {0, 6, 15}) {
      SCOPED_TRACE("mesh " + std::to_string(k++ / 3) + ", chart_count " + std::to_string(count));
      SurfaceData changed = mesh;
      change(changed);
      ExpectAlike(changed, mesh, count, tolerance, stages);
    }
}

TEST(Invariance, Rotation) {
  ForAll(1e-9, [](SurfaceData& mesh) {
    const double a = 0.9, b = 2.1;
    for (auto& p : mesh.vertices) {
      const double x = std::cos(a) * p[0] - std::sin(a) * p[1], y = std::sin(a) * p[0] + std::cos(a) * p[1];
      p = {x, std::cos(b) * y - std::sin(b) * p[2], std::sin(b) * y + std::cos(b) * p[2]};
    }
  });
}

TEST(Invariance, SmallAndLargeScale) {
  for (double factor : {1e-10, 1e10})
    ForAll(1e-9, [&](SurfaceData& mesh) {
      for (auto& p : mesh.vertices)
        for (double& x : p) x *= factor;
    });
}

TEST(Invariance, PowersOfTwoChangeNoByte) {
  const SurfaceData mesh = Irregular(shapes::Torus(12));
  const SurfaceChange atlas = Atlas(mesh, 4);
  for (int exponent : {-300, -20, 300}) {
    SurfaceData changed = mesh;
    for (auto& p : changed.vertices)
      for (double& x : p) x = std::ldexp(x, exponent);
    const SurfaceChange scaled = Atlas(changed, 4);
    EXPECT_EQ(scaled.chart_ids, atlas.chart_ids) << exponent;
    EXPECT_TRUE(scaled.wedge_texcoords == atlas.wedge_texcoords) << exponent;
    EXPECT_NEAR(*scaled.report.seam_length, *atlas.report.seam_length, 1e-9) << exponent;
  }
}

// The flattening doesn't depend on it either.
TEST(Invariance, StretchOfATurnedMovedAndScaledMesh) {
  for (const SurfaceData& mesh : {Irregular(shapes::Torus(12)), Irregular(shapes::Sphere(7))}) {
    SurfaceData changed = mesh;
    for (auto& p : changed.vertices) p = {1e-10 * (p[1] + 2), -1e-10 * p[0], 1e-10 * (p[2] - 1)};
    const Report a = Atlas(mesh, 5).report, b = Atlas(changed, 5).report;
    EXPECT_NEAR(*a.l2_stretch, *b.l2_stretch, 1e-5);
    EXPECT_NEAR(*a.linf_stretch, *b.linf_stretch, 1e-3);
    EXPECT_EQ(a.charts, b.charts);
  }
}

TEST(Invariance, Translation) {
  ForAll(1e-9, [](SurfaceData& mesh) {
    for (auto& p : mesh.vertices) p = {p[0] + 1000, p[1] - 500, p[2] + 3};
  });
}

TEST(Invariance, NumberingOfVertices) {
  ForAll(1e-9, [](SurfaceData& mesh) {
    std::vector<int> place(mesh.vertices.size());
    std::iota(place.begin(), place.end(), 0);
    std::mt19937 random(4);
    std::shuffle(place.begin(), place.end(), random);
    const auto old = mesh.vertices;
    for (size_t v = 0; v < old.size(); ++v) mesh.vertices[place[v]] = old[v];
    for (auto& face : mesh.faces)
      for (int& v : face) v = place[v];
  });
}

TEST(Invariance, NumberingOfFacesAndCorners) {
  ForAll(1e-9,
         [](SurfaceData& mesh) {
           std::mt19937 random(6);
           std::shuffle(mesh.faces.begin(), mesh.faces.end(), random);
           for (auto& face : mesh.faces) std::rotate(face.begin(), face.begin() + random() % 3, face.end());
         },
         {Segment, Fill, Straighten});
}

TEST(Invariance, MirrorImage) {
  ForAll(1e-9, [](SurfaceData& mesh) {
    for (auto& p : mesh.vertices) p[0] = -p[0];
    for (auto& face : mesh.faces) std::swap(face[1], face[2]);
  });
}

TEST(Invariance, ChartsAndStretchHardlyHangOnTheTriangles) {
  for (const char* name : {"plush", "cad_part"}) {
    const SurfaceData mesh = shapes::ShapeByName(name).mesh;
    Progress progress;
    const auto charts = [&](const SurfaceData& of) {
      return *TextureAtlas(of, Params(), progress).report.charts;
    };
    const Report as_is = TextureAtlas(mesh, Params(), progress).report,
                 quartered = TextureAtlas(Quartered(mesh), Params(), progress).report;
    EXPECT_LE(*as_is.charts, 4) << name;
    EXPECT_NEAR(charts(test::Noisy(mesh, 0.05, 5)), *as_is.charts, 1) << name;
    EXPECT_NEAR(*quartered.charts, *as_is.charts, 1) << name;
    EXPECT_NEAR(*quartered.l2_stretch, *as_is.l2_stretch, 0.003) << name;
  }
}

TEST(Invariance, TwiceInARow) {
  for (const SurfaceData& mesh : {shapes::Plush(32), shapes::Torus(12)}) {
    const SurfaceChange a = Atlas(mesh, 0), b = Atlas(mesh, 0);
    EXPECT_EQ(a.chart_ids, b.chart_ids);
    EXPECT_TRUE(a.wedge_texcoords == b.wedge_texcoords);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.report.l2_stretch, b.report.l2_stretch);
    EXPECT_EQ(a.report.packing_efficiency, b.report.packing_efficiency);
  }
}

}  // namespace
}  // namespace dcharts
