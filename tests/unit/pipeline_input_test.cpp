// SPDX-License-Identifier: GPL-3.0-or-later
/// Any mesh: what is refused, and that all else ends in a sound atlas.
#include "dcharts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "coarse_shapes.h"

namespace dcharts {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

using Stage = SurfaceChange (*)(const SurfaceData&, const Params&, Progress&);
const std::pair<const char*, Stage> kStages[] = {{"segment", Segment},
                                                 {"fill", Fill},
                                                 {"straighten", Straighten},
                                                 {"merge", Merge},
                                                 {"cut", Cut},
                                                 {"parameterize", Parameterize},
                                                 {"texture_atlas", TextureAtlas},
                                                 {"measure", Measure}};

// The sentence a stage refuses the mesh with; empty when it takes it.
std::string Refusal(Stage stage, const SurfaceData& mesh) {
  Progress progress;
  try {
    stage(mesh, Params(), progress);
  } catch (const Cancelled&) {
    return "cancelled";
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// `word` says what is wrong, `mends` is what MeshLab has against it.
void ExpectRefused(const SurfaceData& mesh, const std::string& word, const std::string& mends) {
  for (const auto& [name, stage] : kStages) {
    const std::string sentence = Refusal(stage, mesh);
    ASSERT_FALSE(sentence.empty()) << name;
    EXPECT_NE(sentence.find(word), std::string::npos) << name << ": " << sentence;
    EXPECT_NE(sentence.find(mends), std::string::npos) << name << ": " << sentence;
    EXPECT_EQ(sentence.back(), '.') << name << ": " << sentence;
    EXPECT_GT(sentence.size(), 30u) << name << ": " << sentence;
  }
}

// Runs every stage and the whole; the atlas must be sound.
void ExpectTaken(const SurfaceData& mesh) {
  for (const auto& [name, stage] : kStages)
    if (stage != TextureAtlas) {
      EXPECT_EQ(Refusal(stage, mesh), "") << name;
    }
  const std::pair<int, bool> cases[] = {{0, false}, {1, true}, {4, false}};
  for (const auto& [count, to_disk] : cases) {
    Params params;
    params.chart_count = count;
    params.cut_to_disk = to_disk;
    Progress progress;
    EXPECT_EQ(test::WrongInAtlas(mesh, TextureAtlas(mesh, params, progress), to_disk), "")
        << "chart_count " << count << (to_disk ? ", disks" : "");
  }
}

SurfaceData FromLists(std::vector<std::array<double, 3>> vertices, std::vector<std::array<int, 3>> faces) {
  SurfaceData mesh;
  mesh.vertices = std::move(vertices);
  mesh.faces = std::move(faces);
  return mesh;
}

SurfaceData Triangle() { return FromLists({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}); }

TEST(Refused, EmptyMesh) { ExpectRefused(SurfaceData(), "empty", "open or create"); }

TEST(Refused, NoFaces) {
  SurfaceData mesh = Triangle();
  mesh.faces.clear();
  ExpectRefused(mesh, "no faces", "\"Surface Reconstruction: Ball Pivoting\"");
}

TEST(Refused, CoordinatesThatAreNoNumber) {
  for (double bad : {kNan, kInfinity, -kInfinity})
    for (size_t d = 0; d < 3; ++d) {
      SurfaceData mesh = shapes::Cube(2);
      mesh.vertices[5][d] = bad;
      ExpectRefused(mesh, "not a number",
                    "\"Conditional Vertex Selection\" and \"Delete Selected Vertices\"");
    }
}

TEST(Refused, NoArea) {
  ExpectRefused(FromLists({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}), "no area",
                "\"Remove Zero Area Faces\"");
  ExpectRefused(FromLists({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}), "no area",
                "\"Remove Zero Area Faces\"");
  ExpectRefused(FromLists({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 1}, {2, 2, 2}}), "no area",
                "\"Remove Zero Area Faces\"");
  // On a line but for rounding.
  const double x = 0.14774253254068487;
  for (const double share : {0.1, 0.25538914642, 0.3, 0.7})
    ExpectRefused(
        FromLists({{x, 0, 6e-17}, {0, 0, 1}, {share * x, 0, 1 - share}, {0, 0, 1}}, {{0, 1, 2}, {2, 3, 0}}),
        "no area", "\"Remove Zero Area Faces\"");
}

TEST(Refused, FaceWithoutVertex) {
  for (int v : {-1, 3}) {
    SurfaceData mesh = Triangle();
    mesh.faces[0][1] = v;
    ExpectRefused(mesh, "vertex", "save the mesh and load it again");
  }
}

TEST(Refused, InputStaysAsItIs) {
  SurfaceData mesh = shapes::Torus(8);
  for (size_t f = 0; f < mesh.faces.size(); ++f) mesh.face_quality.push_back(static_cast<double>(f % 3));
  const SurfaceData before = mesh;
  for (const auto& [name, stage] : kStages) {
    Progress progress;
    stage(mesh, Params(), progress);
    EXPECT_TRUE(mesh.vertices == before.vertices && mesh.faces == before.faces &&
                mesh.face_quality == before.face_quality)
        << name;
  }
}

TEST(Taken, OneFace) { ExpectTaken(Triangle()); }

TEST(Taken, OneVeryThinFace) { ExpectTaken(FromLists({{0, 0, 0}, {1, 0, 0}, {0.3, 1e-5, 0}}, {{0, 1, 2}})); }

TEST(Taken, TwoFaces) {
  ExpectTaken(FromLists({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
}

TEST(Taken, TwoFacesBackToBack) {  // the smallest closed surface
  ExpectTaken(FromLists({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}));
}

TEST(Taken, Tetrahedron) {
  ExpectTaken(
      FromLists({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}));
}

TEST(Taken, SmallestTorus) {  // seven vertices (Moebius, Csaszar), here anywhere in space
  SurfaceData mesh;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(0, 1);
  for (int v = 0; v < 7; ++v) mesh.vertices.push_back({place(random), place(random), place(random)});
  for (int k = 0; k < 7; ++k) {
    mesh.faces.push_back({k, (k + 1) % 7, (k + 3) % 7});
    mesh.faces.push_back({k, (k + 3) % 7, (k + 2) % 7});
  }
  ExpectTaken(mesh);
}

TEST(Taken, FacesWithRepeatedVertices) {
  SurfaceData mesh = shapes::Cube(3);
  mesh.faces.insert(mesh.faces.begin(), {0, 0, 1});
  mesh.faces.insert(mesh.faces.begin() + 7, {2, 5, 2});
  mesh.faces.push_back({3, 3, 3});
  ExpectTaken(mesh);
}

TEST(Taken, FacesWithoutArea) {
  // A row of faces squeezed to a line, and one between three vertices in one place.
  SurfaceData mesh = shapes::Grid(6, 6);
  for (auto& p : mesh.vertices)
    if (std::abs(p[1] - 0.5) < 1e-9) p[1] = 1.0 / 3;
  ExpectTaken(mesh);

  mesh = shapes::Sphere(3);
  const auto face = mesh.faces[17];
  mesh.vertices[face[1]] = mesh.vertices[face[2]] = mesh.vertices[face[0]];
  ExpectTaken(mesh);
}

TEST(Taken, ManyFacesWithoutArea) {
  // T-junctions: each edge of one side of a cube has a face without area on it.
  SurfaceData mesh = shapes::Cube(3);
  const size_t count = mesh.faces.size();
  for (size_t f = 0; f < count; f += 3) {
    const int a = mesh.faces[f][0], b = mesh.faces[f][1];
    const auto &p = mesh.vertices[a], &q = mesh.vertices[b];
    const int m = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
    mesh.faces.push_back({a, b, m});
  }
  ExpectTaken(mesh);
}

TEST(Taken, VerySmallFacesAmongLargeOnes) {
  // Crumpled, of sizes at which faces still count to such that they are without area beside the others.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1, 1);
  for (double size : {1e-5, 1e-6, 3e-7, 1e-7, 3e-8, 1e-9}) {
    SurfaceData mesh = shapes::Grid(2, 2);
    const int first = static_cast<int>(mesh.vertices.size());
    SurfaceData tiny = shapes::Cube(1);
    for (auto& p : tiny.vertices)
      for (double& x : p) x += place(random);
    for (const auto& p : tiny.vertices) mesh.vertices.push_back({size * p[0], size * p[1], 1 + size * p[2]});
    for (const auto& f : tiny.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
    for (const auto& [name, stage] : kStages) EXPECT_EQ(Refusal(stage, mesh), "") << name;
    Progress progress;
    const SurfaceChange atlas = TextureAtlas(mesh, Params(), progress);
    EXPECT_EQ(test::WrongInAtlas(mesh, atlas, false), "") << size;
    // They are not taken apart just because rounding crumples them.
    EXPECT_LE(*atlas.report.charts, 7) << size;
  }
}

TEST(Taken, DuplicateFaces) {
  SurfaceData mesh = shapes::Cube(2);
  const auto faces = mesh.faces;
  for (size_t f = 0; f < faces.size(); f += 4) mesh.faces.push_back(faces[f]);
  ExpectTaken(mesh);
  // All of them twice, the second time the other way round.
  mesh.faces = faces;
  for (const auto& f : faces) mesh.faces.push_back({f[0], f[2], f[1]});
  ExpectTaken(mesh);
}

TEST(Taken, UnreferencedVertices) {
  SurfaceData mesh = shapes::Cube(3);
  const SurfaceData plain = mesh;
  mesh.vertices.push_back({kNan, kInfinity, 0});
  mesh.vertices.push_back({1e300, -1e300, 1e300});
  ExpectTaken(mesh);
  Progress progress;
  EXPECT_EQ(TextureAtlas(mesh, Params(), progress).wedge_texcoords,
            TextureAtlas(plain, Params(), progress).wedge_texcoords);
}

TEST(Taken, NonManifoldEdgesAndVertices) {
  ExpectTaken(shapes::NonManifoldFin(3));
  ExpectTaken(shapes::BowTie(3));
  // Two cubes that share one edge's vertices: an edge with four faces.
  SurfaceData mesh = shapes::Cube(2);
  const SurfaceData cube = mesh;
  std::vector<int> vertex;
  for (const auto& p : cube.vertices) {
    std::array<double, 3> q{p[0] + 1, p[1] + 1, p[2]};
    int found = -1;
    for (int v = 0; v < static_cast<int>(cube.vertices.size()); ++v)
      if (test::Norm(test::Minus(cube.vertices[v], q)) < 1e-9) found = v;
    if (found < 0) {
      found = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(q);
    }
    vertex.push_back(found);
  }
  for (const auto& f : cube.faces) mesh.faces.push_back({vertex[f[0]], vertex[f[1]], vertex[f[2]]});
  ExpectTaken(mesh);
}

TEST(Taken, OrientationsAtRandom) {
  SurfaceData mesh = shapes::Sphere(2);
  std::mt19937 random(1);
  for (auto& f : mesh.faces)
    if (random() % 2) std::swap(f[1], f[2]);
  ExpectTaken(mesh);
}

TEST(Taken, SoupOfTriangles) {
  SurfaceData mesh;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  for (int k = 0; k < 32; ++k) {
    for (int i = 0; i < 3; ++i) mesh.vertices.push_back({place(random), place(random), place(random)});
    mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  ExpectTaken(mesh);
  Progress progress;
  EXPECT_EQ(TextureAtlas(mesh, Params(), progress).report.charts, 32);
}

// Few vertices and many faces between any three of them: nearly all edges are non-manifold.
TEST(Taken, FacesAtRandomOnFewVertices) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 1);
  for (int trial = 0; trial < 5; ++trial) {
    SurfaceData mesh;
    const int n = 5 + 2 * trial;
    for (int v = 0; v < n; ++v) mesh.vertices.push_back({place(random), place(random), place(random)});
    for (int f = 0; f < 40; ++f) {
      std::array<int, 3> face;
      for (int& v : face) v = static_cast<int>(random() % static_cast<unsigned>(n));
      mesh.faces.push_back(face);
    }
    SCOPED_TRACE(trial);
    Params params;
    params.chart_count = trial % 4;
    Progress progress;
    EXPECT_EQ(test::WrongInAtlas(mesh, TextureAtlas(mesh, params, progress), false), "");
  }
}

TEST(Taken, NoisyClosedSurface) {
  SurfaceData mesh = shapes::Sphere(6);
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0, 0.15);
  for (auto& p : mesh.vertices)
    for (double& x : p) x += noise(random);
  for (int count : {0, 1, 5}) {
    Params params;
    params.chart_count = count;
    Progress progress;
    EXPECT_EQ(test::WrongInAtlas(mesh, TextureAtlas(mesh, params, progress), false), "") << count;
  }
}

TEST(Taken, SpikesAndNeedles) {
  SurfaceData mesh = shapes::Sphere(3);
  for (size_t v = 0; v < mesh.vertices.size(); v += 9)
    for (double& x : mesh.vertices[v]) x *= 8;
  ExpectTaken(mesh);
  mesh = shapes::OpenCylinder(16);
  for (auto& p : mesh.vertices) p[2] *= 1e4;  // faces ten thousand times as long as wide
  ExpectTaken(mesh);
}

TEST(Taken, MoreChartsThanFaces) {
  const SurfaceData mesh = shapes::Cube(1);
  Params params;
  params.chart_count = 1000;
  Progress progress;
  const SurfaceChange atlas = TextureAtlas(mesh, params, progress);
  EXPECT_EQ(test::WrongInAtlas(mesh, atlas, false), "");
  EXPECT_LE(*atlas.report.charts, 12);
}

TEST(Taken, ParametersAtTheirEnds) {
  const SurfaceData mesh = shapes::Torus(14);
  auto check = [&](const char* what, const Params& params) {
    Progress progress;
    EXPECT_EQ(test::WrongInAtlas(mesh, TextureAtlas(mesh, params, progress), params.cut_to_disk), "") << what;
  };
  Params params;
  params.chart_count = 6;
  const Params base = params;
  params.max_fitting_error = 1e-6;
  check("max_fitting_error small", params);
  params.max_fitting_error = 4;
  check("max_fitting_error large", params);
  params = base;
  params.fitting_weight = params.compactness_weight = params.straightness_weight = 0;
  check("no weights", params);
  params.fitting_weight = params.compactness_weight = params.straightness_weight = 10;
  check("large weights", params);
  params = base;
  params.max_iterations = 1;
  check("one iteration", params);
  params = base;
  params.seed_candidates = 1;
  params.seed_percent = 100;
  check("all faces are candidates", params);
  params = base;
  params.small_hole_percent = 0;
  check("no small holes", params);
  params.small_hole_percent = 100;
  check("only small holes", params);
  params = base;
  params.merge_threshold = 4;
  check("all merged", params);
  params.merge_threshold = 0;
  check("none merged", params);
  params = base;
  params.max_dart_percent = 1000;
  params.dart_fitting_error = 0;
  check("darts everywhere", params);
  params.max_dart_percent = 0;
  check("no darts", params);
  params = base;
  params.texture_size = 16;
  params.padding = 4;
  check("tiny texture", params);
}

// --- chart ids in face quality; without texcoords Measure reports just them

struct Read {
  int charts, unassigned;
};
Read ReadQuality(const std::vector<double>& quality) {
  SurfaceData mesh = shapes::Grid(4, 1);  // eight faces in a row
  mesh.face_quality = quality;
  Progress progress;
  const Report report = Measure(mesh, Params(), progress).report;
  return {*report.charts, *report.unassigned_faces};
}
bool operator==(const Read& a, const Read& b) { return a.charts == b.charts && a.unassigned == b.unassigned; }
std::ostream& operator<<(std::ostream& out, const Read& r) {
  return out << r.charts << " charts, " << r.unassigned << " unassigned";
}

TEST(QualityAsChartIds, PlainIds) {
  EXPECT_EQ(ReadQuality({0, 0, 0, 0, 1, 1, 1, 1}), (Read{2, 0}));
  EXPECT_EQ(ReadQuality({7, 7, 7, 7, 3, 3, 900, 900}), (Read{3, 0})) << "gaps don't matter";
}

TEST(QualityAsChartIds, WhatIsNoIdIsUnassigned) {
  for (double bad : {kNan, -1.0, -0.5, 0.5, 1.02, 0.98, -1e30, 1e30, kInfinity, -kInfinity, -0.005})
    EXPECT_EQ(ReadQuality({bad, bad, 0, 0, 1, 1, 1, 1}), (Read{2, 2})) << bad;
}

TEST(QualityAsChartIds, NearlyIntegersAreRounded) {
  EXPECT_EQ(ReadQuality({0.009, 0.009, 0, 0, 1.009, 0.991, 1, 1}), (Read{2, 0}));
}

TEST(QualityAsChartIds, AnIdInSeveralPiecesIsSplit) {
  EXPECT_EQ(ReadQuality({0, 0, 1, 1, 0, 0, 1, 1}), (Read{4, 0}));
}

TEST(QualityAsChartIds, AllAlikeIsOneChart) {
  for (double all : {0.0, 5.0, -1.0, 0.5, 1e30, kNan})
    EXPECT_EQ(ReadQuality(std::vector<double>(8, all)), (Read{1, 0})) << all;
  EXPECT_EQ(ReadQuality({}), (Read{1, 0})) << "no quality at all";
}

TEST(QualityAsChartIds, EveryStageTakesAnyQuality) {
  SurfaceData mesh = shapes::Sphere(2);
  const double values[] = {0, 1, kNan, -1, 0.5, 1e30, 2, 2, 2, 2, 2, 7, kInfinity};
  for (size_t f = 0; f < mesh.faces.size(); ++f) mesh.face_quality.push_back(values[f * 7919 / 5 % 13]);
  for (const auto& [name, stage] : kStages) EXPECT_EQ(Refusal(stage, mesh), "") << name;
  Progress progress;
  EXPECT_EQ(test::WrongInAtlas(mesh, Parameterize(mesh, Params(), progress), false), "");
}

TEST(QualityAsChartIds, PaintedChartsOfAnyKindAreParameterized) {
  // Stripes, a checkerboard, rings around a handle, everything in one.
  const SurfaceData plain = shapes::Torus(7);
  for (int kind = 0; kind < 4; ++kind) {
    SurfaceData mesh = plain;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& p = mesh.vertices[mesh.faces[f][0]];
      const double angle = std::atan2(p[1], p[0]) + 3.2;
      const double id[] = {std::floor(angle), static_cast<double>(f % 2), p[2] > 0 ? 1.0 : 2.0, 4.0};
      mesh.face_quality.push_back(id[kind]);
    }
    for (bool to_disk : {false, true}) {
      Params params;
      params.cut_to_disk = to_disk;
      Progress progress;
      const SurfaceChange cut = Cut(mesh, params, progress);
      SurfaceData between = mesh;
      between.face_quality.assign(cut.chart_ids.begin(), cut.chart_ids.end());
      between.seams = cut.seams;
      EXPECT_EQ(test::WrongInAtlas(between, Parameterize(between, params, progress), to_disk), "")
          << kind << " " << to_disk;
    }
  }
}

// --- cancelling

TEST(Cancelling, EveryCallbackCanCancel) {
  SurfaceData mesh = shapes::TwoComponents(2);
  for (const auto& [name, stage] : kStages) {
    Params params;
    params.chart_count = 3;
    params.texture_size = 64;
    int calls = 0, last = 0;
    Progress counting([&](int percent, const char* text) {
      ++calls;
      EXPECT_GE(percent, 0);
      EXPECT_LE(percent, 100);
      EXPECT_GE(percent, last);
      EXPECT_STRNE(text, "");
      last = percent;
      return true;
    });
    stage(mesh, params, counting);
    EXPECT_GT(calls, 0) << name;
    const int total = calls;
    for (int n = 1; n <= total; n += 1 + n / 20) {
      calls = 0;
      Progress cancelling([&](int, const char*) { return ++calls < n; });
      bool cancelled = false;
      try {
        stage(mesh, params, cancelling);
      } catch (const Cancelled&) {
        cancelled = true;
      }
      // With several threads the number of calls varies a little.
      EXPECT_EQ(cancelled, calls >= n) << name << " at call " << n;
      EXPECT_LE(calls, n) << name << ": called again after false";
    }
  }
}

}  // namespace
}  // namespace dcharts
