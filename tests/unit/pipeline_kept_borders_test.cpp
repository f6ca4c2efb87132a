// SPDX-License-Identifier: GPL-3.0-or-later
/// keep_seams and crease_angle: borders that charts are kept to.
#include "dcharts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "pattern/pattern.h"
#include "run_stages.h"
#include "shapes.h"

namespace dcharts {
namespace {

using test::kAllStages;
using test::Kept;
using test::RunAll;

SurfaceChange Atlas(const SurfaceData& mesh, const Params& params, std::string* log = nullptr) {
  Progress progress({}, [&](const std::string& line) {
    if (log) *log += line + "\n";
  });
  return TextureAtlas(mesh, params, progress);
}

test::Vec3 NormalOf(const SurfaceData& mesh, int face) {
  const auto& [a, b, c] = mesh.faces[face];
  const test::Vec3 n = test::Cross(test::Minus(mesh.vertices[b], mesh.vertices[a]),
                                   test::Minus(mesh.vertices[c], mesh.vertices[a]));
  const double length = test::Norm(n);
  return {n[0] / length, n[1] / length, n[2] / length};
}

// Half-edges whose faces' normals differ by more than an angle.
std::vector<int> SharpEdges(const SurfaceData& mesh, double degrees) {
  const std::vector<int> opposite = test::Opposites(mesh);
  std::vector<int> sharp;
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h)
    if (opposite[h] > h && test::Dot(NormalOf(mesh, h / 3), NormalOf(mesh, opposite[h] / 3)) <
                               std::cos(degrees * std::acos(-1) / 180))
      sharp.push_back(h);
  return sharp;
}

// Of the half-edges, those with one chart on both sides.
int WithinCharts(const SurfaceData& mesh, const std::vector<int>& half_edges, const std::vector<int>& ids) {
  const std::vector<int> opposite = test::Opposites(mesh);
  return static_cast<int>(std::count_if(half_edges.begin(), half_edges.end(),
                                        [&](int h) { return ids[h / 3] == ids[opposite[h] / 3]; }));
}

int Charts(const SurfaceChange& change) { return change.report.charts.value(); }

TEST(CreaseAngle, ACubeHasSixCharts) {
  const SurfaceData cube = shapes::Cube(4);
  Params params;
  EXPECT_LT(Charts(Atlas(cube, params)), 6);
  params.crease_angle = 45;
  EXPECT_EQ(Charts(Atlas(cube, params)), 6);
  params.crease_angle = 90;  // no sharper than that
  EXPECT_LT(Charts(Atlas(cube, params)), 6);
  params.crease_angle = 0;  // what is flat is no crease
  EXPECT_EQ(Charts(Atlas(cube, params)), 6);
}

TEST(CreaseAngle, ATargetCannotBeReachedAcross) {
  Params params;
  params.crease_angle = 45;
  params.target_charts = 2;
  std::string log;
  EXPECT_EQ(Charts(Atlas(shapes::Cube(4), params, &log)), 6);
  EXPECT_NE(log.find("2 charts were asked for"), std::string::npos) << log;
}

TEST(CreaseAngle, CadPartKeepsItsCreases) {
  const SurfaceData part = shapes::CadPart(24);
  const std::vector<int> sharp = SharpEdges(part, 40);
  ASSERT_GT(sharp.size(), 50u);
  for (const MergeMethod by : {MergeMethod::kTrialFlattening, MergeMethod::kBoundaryRegion}) {
    Params params;
    params.merge_by = by;
    ASSERT_GT(WithinCharts(part, sharp, Atlas(part, params).chart_ids), 0);
    params.crease_angle = 40;
    const SurfaceChange change = Atlas(part, params);
    EXPECT_EQ(WithinCharts(part, sharp, change.chart_ids), 0);
    EXPECT_EQ(test::WrongInAtlas(part, change, false), "");
  }
}

TEST(KeptBorders, StageByStageGivesTheSameBytes) {
  Params params;
  params.crease_angle = 40;
  params.chart_count = 12;
  SurfaceData mesh = shapes::CadPart(24);
  // A texture with a seam of its own.
  for (const auto& face : mesh.faces) {
    const bool right = NormalOf(mesh, static_cast<int>(&face - mesh.faces.data()))[0] > 0;
    mesh.wedge_texcoords.emplace_back();
    for (int k = 0; k < 3; ++k) {
      mesh.wedge_texcoords.back()[2 * k] = static_cast<float>(mesh.vertices[face[k]][0] + (right ? 10 : 0));
      mesh.wedge_texcoords.back()[2 * k + 1] = static_cast<float>(mesh.vertices[face[k]][1]);
    }
  }
  params.keep_seams = true;
  const SurfaceChange once = Atlas(mesh, params);
  for (const Kept kept : {Kept::kAll, Kept::kFile}) {
    const SurfaceChange stages = RunAll(mesh, params, kept, kAllStages);
    EXPECT_EQ(stages.chart_ids, once.chart_ids);
    EXPECT_TRUE(stages.wedge_texcoords == once.wedge_texcoords);
    EXPECT_EQ(stages.report.seam_length, once.report.seam_length);
  }
}

// A plane whose texture is cut along x = 1/2.
SurfaceData PlaneInTwo(double from, double to) {
  SurfaceData mesh = shapes::Grid(8, 8);
  double low = 1e9, high = -1e9;
  for (const auto& v : mesh.vertices) {
    low = std::min(low, v[0]);
    high = std::max(high, v[0]);
  }
  for (const auto& face : mesh.faces) {
    const auto at = [&](int k, int d) { return (mesh.vertices[face[k]][d] - low) / (high - low); };
    const double x = (at(0, 0) + at(1, 0) + at(2, 0)) / 3;
    std::array<float, 6> uv;
    for (int k = 0; k < 3; ++k) {
      const bool on_cut = std::abs(at(k, 0) - 0.5) < 1e-9 && at(k, 1) > from + 1e-9 && at(k, 1) < to - 1e-9;
      uv[2 * k] = static_cast<float>(at(k, 0) + (on_cut && x > 0.5 ? 0.01 : 0));
      uv[2 * k + 1] = static_cast<float>(at(k, 1));
    }
    mesh.wedge_texcoords.push_back(uv);
  }
  return mesh;
}

TEST(KeepSeams, ATextureInTwoStaysInTwo) {
  const SurfaceData plane = PlaneInTwo(-1, 2);
  Params params;
  EXPECT_EQ(Charts(Atlas(plane, params)), 1);
  params.keep_seams = true;
  const SurfaceChange change = Atlas(plane, params);
  EXPECT_EQ(Charts(change), 2);
  EXPECT_EQ(test::WrongInAtlas(plane, change, false), "");
}

TEST(KeepSeams, ASeamThatEndsInsideIsNoBorder) {
  const SurfaceData plane = PlaneInTwo(-1, 0.6);
  Params params;
  params.keep_seams = true;
  const SurfaceChange change = Atlas(plane, params);
  EXPECT_EQ(Charts(change), 1);
  EXPECT_EQ(test::WrongInAtlas(plane, change, false), "");
}

TEST(KeepSeams, ATextureIndexIsASeamToo) {
  SurfaceData plane = PlaneInTwo(2, 2);
  for (const auto& uv : plane.wedge_texcoords)
    plane.wedge_texture_index.push_back((uv[1] + uv[3] + uv[5]) / 3 > 0.5 ? 1 : 0);
  Params params;
  params.keep_seams = true;
  EXPECT_EQ(Charts(Atlas(plane, params)), 2);
}

TEST(KeepSeams, SaysThatThereAreNone) {
  Params params;
  params.keep_seams = true;
  std::string log;
  EXPECT_EQ(Charts(Atlas(shapes::Grid(4, 4), params, &log)), 1);
  EXPECT_NE(log.find("keep_seams finds no seams"), std::string::npos) << log;
}

TEST(KeptBorders, PatternsKeepThemToo) {
  for (const PatternMaterial material : {PatternMaterial::kFabric, PatternMaterial::kPaper}) {
    Params params;
    params.size = 200;
    params.material = material;
    const auto pieces = [&] {
      Progress progress;
      return MakePattern(shapes::Cube(4), params, progress).pattern.pieces.size();
    };
    EXPECT_LT(pieces(), 6u);
    params.crease_angle = 45;
    EXPECT_EQ(pieces(), 6u);
  }
}

TEST(Texcoords, ThatAreReplacedAreMentioned) {
  SurfaceData plane = PlaneInTwo(-1, 2);
  std::string log;
  Atlas(plane, {}, &log);
  EXPECT_NE(log.find("Duplicate Current Layer"), std::string::npos) << log;
  log.clear();
  plane.wedge_texcoords.assign(plane.faces.size(), {});
  Atlas(plane, {}, &log);
  EXPECT_EQ(log.find("Duplicate Current Layer"), std::string::npos) << log;
}

}  // namespace
}  // namespace dcharts
