// SPDX-License-Identifier: GPL-3.0-or-later
/// Measure on texcoords of any origin.
#include "dcharts.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "shapes.h"

namespace dcharts {
namespace {

using Map = std::function<std::array<double, 2>(const test::Vec3&)>;

// Every corner's texcoord from its place.
void Texture(SurfaceData& mesh, const Map& map) {
  mesh.wedge_texcoords.clear();
  for (const auto& face : mesh.faces) {
    std::array<float, 6> t;
    for (size_t i = 0; i < 3; ++i) {
      const auto uv = map(mesh.vertices[face[i]]);
      t[2 * i] = static_cast<float>(uv[0]);
      t[2 * i + 1] = static_cast<float>(uv[1]);
    }
    mesh.wedge_texcoords.push_back(t);
  }
}

SurfaceData TexturedGrid(const Map& map, int n = 8) {
  SurfaceData mesh = shapes::Grid(n, n);
  Texture(mesh, map);
  return mesh;
}

Report MeasureLogged(const SurfaceData& mesh, std::string* log = nullptr) {
  Progress progress({}, [&](const std::string& line) {
    if (log) *log += line + "\n";
  });
  return Measure(mesh, Params(), progress).report;
}

TEST(Measure, WritesNothing) {
  const SurfaceData mesh = TexturedGrid([](const auto& p) { return std::array<double, 2>{p[0], p[1]}; });
  Progress progress;
  const SurfaceChange change = Measure(mesh, Params(), progress);
  EXPECT_TRUE(change.chart_ids.empty() && change.colors.empty() && change.wedge_texcoords.empty() &&
              change.seams.empty() && change.seam_lines.empty());
  EXPECT_FALSE(change.remove_seams);
}

TEST(Measure, IsometryOfAnySizeAndPlace) {
  for (double scale : {1.0, 0.01, 40.0}) {
    const Report report = MeasureLogged(TexturedGrid([&](const auto& p) {
      return std::array<double, 2>{scale * (0.8 * p[0] - 0.6 * p[1]), scale * (0.6 * p[0] + 0.8 * p[1])};
    }));
    EXPECT_EQ(report.charts, 1);
    EXPECT_NEAR(*report.l2_stretch, 1, 1e-5) << scale;
    EXPECT_NEAR(*report.linf_stretch, 1, 1e-4) << scale;
    EXPECT_NEAR(*report.l2_shear, 0, 1e-6) << scale;
    EXPECT_EQ(report.flipped_faces, 0);
    EXPECT_EQ(report.degenerate_faces, 0);
    EXPECT_EQ(report.overlapping_faces, 0);
    EXPECT_EQ(report.seam_length, 0.0);
  }
}

// uv = (2x, y): the singular values from UV are 1/2 and 1, the scale that makes the areas equal sqrt(2).
TEST(Measure, KnownDistortion) {
  const Report report = MeasureLogged(TexturedGrid([](const auto& p) {
    return std::array<double, 2>{2 * p[0], p[1]};
  }));
  EXPECT_NEAR(*report.l2_stretch, std::sqrt(1.25), 1e-6);
  EXPECT_NEAR(*report.linf_stretch, std::sqrt(2), 1e-6);
  EXPECT_NEAR(*report.l2_shear, 0.2, 1e-6);  // (2 - 1)^2 / (2^2 + 1^2)
  EXPECT_NEAR(*report.packing_efficiency, 0.5, 1e-6);
}

// A shear by s: singular values with product 1 and squares that add up to 2 + s^2.
TEST(Measure, KnownShear) {
  for (double s : {0.1, 0.5, 2.0}) {
    const Report report = MeasureLogged(TexturedGrid([&](const auto& p) {
      return std::array<double, 2>{p[0] + s * p[1], p[1]};
    }));
    EXPECT_NEAR(*report.l2_stretch, std::sqrt(1 + s * s / 2), 1e-5);
    const double largest = (s + std::sqrt(s * s + 4)) / 2;
    EXPECT_NEAR(*report.linf_stretch, largest, 1e-5);
    EXPECT_NEAR(*report.l2_shear, s * s / (2 + s * s), 1e-5);
  }
}

TEST(Measure, MirroredChartIsNotFlipped) {
  const Report report = MeasureLogged(TexturedGrid([](const auto& p) {
    return std::array<double, 2>{-p[0], p[1]};
  }));
  EXPECT_EQ(report.flipped_faces, 0);
  EXPECT_NEAR(*report.l2_stretch, 1, 1e-6);
  EXPECT_NEAR(*report.linf_stretch, 1, 1e-6);
}

TEST(Measure, FlippedFacesAreCounted) {
  // The vertex at (1/2, 1/2) is pulled over its neighbours' edges.
  const SurfaceData mesh = TexturedGrid([](const auto& p) {
    const bool middle = std::abs(p[0] - 0.5) < 1e-9 && std::abs(p[1] - 0.5) < 1e-9;
    return middle ? std::array<double, 2>{0.5 + 1.4 / 8, 0.5} : std::array<double, 2>{p[0], p[1]};
  });
  int flipped = 0;
  std::vector<test::GridUv> grid;
  for (const auto& t : mesh.wedge_texcoords) {
    grid.push_back(test::OnUvGrid(t));
    flipped += test::TwiceGridArea(grid.back()) < 0;
  }
  ASSERT_GT(flipped, 0);
  const Report report = MeasureLogged(mesh);
  EXPECT_EQ(report.flipped_faces, flipped);
  EXPECT_TRUE(std::isinf(*report.linf_stretch));
  std::set<int> overlapping;
  for (const auto& [i, j] : test::AllOverlaps(grid)) overlapping.insert({i, j});
  EXPECT_EQ(report.overlapping_faces, static_cast<int>(overlapping.size()));
}

TEST(Measure, FaceWithoutUvAreaIsCountedAndInfinite) {
  // Two vertices of one face in one place.
  SurfaceData mesh = TexturedGrid([](const auto& p) {
    return std::array<double, 2>{p[0] < 1e-9 && p[1] < 1.0 / 8 + 1e-9 ? 0.0 : p[0],
                                 p[0] < 1e-9 && p[1] < 1.0 / 8 + 1e-9 ? 0.0 : p[1]};
  });
  int degenerate = 0;
  for (const auto& t : mesh.wedge_texcoords) degenerate += test::TwiceGridArea(test::OnUvGrid(t)) == 0;
  ASSERT_EQ(degenerate, 1);
  const Report report = MeasureLogged(mesh);
  EXPECT_TRUE(std::isinf(*report.linf_stretch));
  EXPECT_EQ(report.degenerate_faces, 1);
  EXPECT_EQ(report.flipped_faces, 0);
}

TEST(Measure, OverlappingChartsAreCounted) {
  // All six sides of a cube in one place.
  SurfaceData mesh = shapes::Cube(1);
  for (const auto& face : mesh.faces) {
    const test::Vec3& a = mesh.vertices[face[0]];
    const test::Vec3 n =
        test::Cross(test::Minus(mesh.vertices[face[1]], a), test::Minus(mesh.vertices[face[2]], a));
    const size_t axis = std::abs(n[0]) > 0.5 ? 0 : std::abs(n[1]) > 0.5 ? 1 : 2;
    std::array<float, 6> t;
    for (size_t i = 0; i < 3; ++i) {
      t[2 * i] = static_cast<float>(mesh.vertices[face[i]][(axis + 1) % 3]);
      t[2 * i + 1] = static_cast<float>(mesh.vertices[face[i]][(axis + 2) % 3]);
    }
    mesh.wedge_texcoords.push_back(t);
  }
  const Report report = MeasureLogged(mesh);
  EXPECT_EQ(report.overlapping_faces, 12);
  EXPECT_NEAR(*report.l2_stretch, 1, 1e-6);
}

// Pairs of small triangles that touch or are apart, with corners on the grid of the texcoords.
TEST(Measure, TrianglesThatOnlyTouchDoNotOverlap) {
  std::mt19937 random(1);
  SurfaceData mesh;
  const auto add = [&](const std::array<int, 6>& corners) {
    const int v = static_cast<int>(mesh.vertices.size());
    std::array<float, 6> uv;
    for (size_t k = 0; k < 6; ++k) uv[k] = static_cast<float>(std::ldexp(corners[k], -24));
    for (size_t i = 0; i < 3; ++i)
      mesh.vertices.push_back({double(corners[2 * i]), double(corners[2 * i + 1]), 0});
    mesh.faces.push_back({v, v + 1, v + 2});
    mesh.wedge_texcoords.push_back(uv);
  };
  constexpr int kSize = 10, kPlaces = 200, kFirst = 1 << 22;
  for (int place = 0; place < kPlaces * kPlaces; ++place) {
    std::array<int, 6> a, b;
    for (auto* t : {&a, &b})
      for (size_t k = 0; k < 6; ++k)
        (*t)[k] = kFirst + 2 * kSize * (k % 2 == 0 ? place % kPlaces : place / kPlaces) +
                  static_cast<int>(random() % (kSize + 1));
    const auto grid = [](const std::array<int, 6>& t) {
      return test::GridUv{t[0], t[1], t[2], t[3], t[4], t[5]};
    };
    if (test::TwiceGridArea(grid(a)) <= 0 || test::TwiceGridArea(grid(b)) <= 0 ||
        test::InteriorsMeet(grid(a), grid(b)))
      continue;
    add(a);
    add(b);
  }
  ASSERT_GT(mesh.faces.size(), 5000u);
  add({0, 0, 11950000, 0, 0, 1000});  // the box of all texcoords is no power of two
  EXPECT_EQ(*MeasureLogged(mesh).overlapping_faces, 0);
}

TEST(Measure, ChartsAreFacesJoinedByEqualTexcoords) {
  // The left and the right half apart, then the same by texture index only.
  auto identity = [](const test::Vec3& p) { return std::array<double, 2>{p[0], p[1]}; };
  SurfaceData mesh = TexturedGrid(identity);
  auto right = [&](size_t f) {
    double x = 0;
    for (int v : mesh.faces[f]) x += mesh.vertices[v][0] / 3;
    return x > 0.5;
  };
  SurfaceData apart = mesh;
  for (size_t f = 0; f < mesh.faces.size(); ++f)
    for (size_t i = 0; i < 3 && right(f); ++i) apart.wedge_texcoords[f][2 * i] += 0.25f;
  Report report = MeasureLogged(apart);
  EXPECT_EQ(report.charts, 2);
  EXPECT_NEAR(*report.seam_length, 1, 1e-9);

  for (size_t f = 0; f < mesh.faces.size(); ++f) mesh.wedge_texture_index.push_back(right(f) ? 1 : 0);
  report = MeasureLogged(mesh);
  EXPECT_EQ(report.charts, 2);
  EXPECT_NEAR(*report.seam_length, 1, 1e-9);
}

TEST(Measure, QualityDoesNotMatterWhereTexcoordsAre) {
  SurfaceData mesh = TexturedGrid([](const auto& p) { return std::array<double, 2>{p[0], p[1]}; });
  for (size_t f = 0; f < mesh.faces.size(); ++f) mesh.face_quality.push_back(static_cast<double>(f));
  EXPECT_EQ(MeasureLogged(mesh).charts, 1);
}

TEST(Measure, TexcoordsOutsideTheUnitSquareAreSaid) {
  std::string log;
  MeasureLogged(TexturedGrid([](const auto& p) { return std::array<double, 2>{p[0], p[1]}; }), &log);
  EXPECT_EQ(log, "");
  const Report report = MeasureLogged(TexturedGrid([](const auto& p) {
                                        return std::array<double, 2>{p[0] + 0.5, p[1]};
                                      }),
                                      &log);
  EXPECT_NE(log.find("outside"), std::string::npos) << log;
  EXPECT_NEAR(*report.l2_stretch, 1, 1e-6);
}

TEST(Measure, WithoutTexcoordsOnlyTheCharts) {
  SurfaceData mesh = shapes::Cube(2);
  for (size_t f = 0; f < mesh.faces.size(); ++f) mesh.face_quality.push_back(f < 20 ? 0 : -1);
  for (int zeros = 0; zeros < 2; ++zeros) {
    std::string log;
    const Report report = MeasureLogged(mesh, &log);
    EXPECT_TRUE(report.charts && report.unassigned_faces && report.seam_length);
    EXPECT_EQ(report.unassigned_faces, static_cast<int>(mesh.faces.size()) - 20);
    EXPECT_FALSE(report.l2_stretch || report.linf_stretch || report.flipped_faces ||
                 report.overlapping_faces || report.packing_efficiency);
    EXPECT_NE(log.find("texture coordinates"), std::string::npos);
    mesh.wedge_texcoords.assign(mesh.faces.size(), {});  // a host that always has some
  }
}

TEST(Measure, FacesWithoutAreaCountNowhere) {
  SurfaceData mesh = TexturedGrid([](const auto& p) { return std::array<double, 2>{p[0], p[1]}; });
  const int m = static_cast<int>(mesh.vertices.size());
  const int a = mesh.faces[0][0], b = mesh.faces[0][1];
  mesh.vertices.push_back(mesh.vertices[a]);
  mesh.faces.push_back({a, b, m});
  mesh.wedge_texcoords.push_back({0, 0, 1, 1, 0, 0});
  mesh.faces.push_back({a, a, b});
  mesh.wedge_texcoords.push_back({0, 0, 1, 1, 0, 0});
  const Report report = MeasureLogged(mesh);
  EXPECT_NEAR(*report.l2_stretch, 1, 1e-6);
  EXPECT_NEAR(*report.linf_stretch, 1, 1e-6);
  EXPECT_EQ(report.flipped_faces, 0);
  EXPECT_EQ(report.degenerate_faces, 0);
  EXPECT_EQ(report.overlapping_faces, 0);
}

TEST(Measure, AnyFloatIsTaken) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  for (float bad : {nan, infinity, -infinity, 3e38f, -3e38f, 1e-45f}) {
    SurfaceData mesh = TexturedGrid([](const auto& p) { return std::array<double, 2>{p[0], p[1]}; });
    mesh.wedge_texcoords[7][3] = bad;
    const Report report = MeasureLogged(mesh);
    EXPECT_TRUE(report.charts.has_value());
    if (!std::isfinite(bad)) {
      EXPECT_TRUE(std::isinf(*report.linf_stretch)) << bad;
      EXPECT_EQ(report.degenerate_faces, 1) << bad;
      EXPECT_EQ(report.flipped_faces, 0) << bad;
      EXPECT_EQ(report.overlapping_faces, 0) << bad;
      EXPECT_NEAR(*report.packing_efficiency, 127.0 / 128, 1e-6) << bad << ": the others fill the square";
    }
    // Different places, so that they are not taken for no texcoords at all.
    for (size_t f = 0; f < mesh.wedge_texcoords.size(); ++f)
      mesh.wedge_texcoords[f] = {bad, 0, bad, 1, bad, f % 2 == 0 ? 0.5f : bad};
    EXPECT_FALSE(std::isnan(*MeasureLogged(mesh).packing_efficiency)) << bad;
  }
}

TEST(Measure, AgreesWithTheAtlasItMeasures) {
  const SurfaceData mesh = shapes::Torus(12);
  Progress progress;
  const SurfaceChange atlas = TextureAtlas(mesh, Params(), progress);
  SurfaceData finished = mesh;
  finished.wedge_texcoords = atlas.wedge_texcoords;
  const Report report = MeasureLogged(finished);
  EXPECT_EQ(report.charts, atlas.report.charts);
  EXPECT_DOUBLE_EQ(*report.l2_stretch, *atlas.report.l2_stretch);
  EXPECT_DOUBLE_EQ(*report.linf_stretch, *atlas.report.linf_stretch);
  EXPECT_DOUBLE_EQ(*report.l2_shear, *atlas.report.l2_shear);
  EXPECT_NEAR(*report.seam_length, *atlas.report.seam_length, 1e-9);
  EXPECT_EQ(report.overlapping_faces, 0);
  EXPECT_DOUBLE_EQ(*report.packing_efficiency, *atlas.report.packing_efficiency);
}

}  // namespace
}  // namespace dcharts
