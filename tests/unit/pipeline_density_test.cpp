// SPDX-License-Identifier: GPL-3.0-or-later
/// density_by: how large charts are beside each other.
#include "dcharts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "shapes.h"

namespace dcharts {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

struct Outcome {
  SurfaceData mesh;
  SurfaceChange atlas;
  std::string log;
};

// A sphere and a cube, with quality by place: the cube is where x > 1.5.
Outcome AtlasOf(const std::function<double(const std::array<double, 3>&)>& quality,
                DensityBy density_by = DensityBy::kVertexQuality) {
  Outcome outcome;
  outcome.mesh = shapes::TwoComponents(4);
  if (quality)
    for (const auto& p : outcome.mesh.vertices) outcome.mesh.vertex_quality.push_back(quality(p));
  Params params;
  params.density_by = density_by;
  Progress progress({}, [&](const std::string& line) { outcome.log += line + "\n"; });
  outcome.atlas = TextureAtlas(outcome.mesh, params, progress);
  return outcome;
}

std::function<double(const std::array<double, 3>&)> SphereAndCube(double on_sphere, double on_cube) {
  return [=](const std::array<double, 3>& p) { return p[0] > 1.5 ? on_cube : on_sphere; };
}

// Texels per length of the charts on the sphere and of those on the cube: least and largest.
struct Densities {
  double sphere[2] = {1e300, 0}, cube[2] = {1e300, 0};
};

Densities DensitiesOf(const Outcome& outcome) {
  std::vector<double> area(static_cast<size_t>(*outcome.atlas.report.charts), 0), uv_area = area;
  std::vector<bool> on_cube(area.size(), false);
  for (size_t f = 0; f < outcome.mesh.faces.size(); ++f) {
    const auto id = static_cast<size_t>(outcome.atlas.chart_ids[f]);
    const auto& t = outcome.atlas.wedge_texcoords[f];
    area[id] += test::FaceArea(outcome.mesh, f);
    uv_area[id] += (double(t[2] - t[0]) * (t[5] - t[1]) - double(t[3] - t[1]) * (t[4] - t[0])) / 2;
    on_cube[id] = outcome.mesh.vertices[outcome.mesh.faces[f][0]][0] > 1.5;
  }
  Densities densities;
  for (size_t id = 0; id < area.size(); ++id) {
    double* range = on_cube[id] ? densities.cube : densities.sphere;
    const double density = std::sqrt(uv_area[id] / area[id]);
    range[0] = std::min(range[0], density);
    range[1] = std::max(range[1], density);
  }
  return densities;
}

void ExpectRatio(const Outcome& outcome, double ratio) {
  EXPECT_EQ(test::WrongInAtlas(outcome.mesh, outcome.atlas, false), "");
  const Densities d = DensitiesOf(outcome);
  constexpr double kTolerance = 0.03;  // a flattened chart has not exactly the area it had
  for (int end : {0, 1}) {
    EXPECT_NEAR(d.sphere[end] / d.sphere[0], 1, kTolerance);
    EXPECT_NEAR(d.cube[end] / d.sphere[0] / ratio, 1, kTolerance);
  }
}

TEST(DensityBy, VertexQualityGivesTexelsPerLengthInProportion) {
  ExpectRatio(AtlasOf(SphereAndCube(1, 2)), 2);
  ExpectRatio(AtlasOf(SphereAndCube(3, 0.6)), 0.2);
}

TEST(DensityBy, OnlyRatiosOfQualitiesCount) {
  const Outcome one = AtlasOf(SphereAndCube(1, 4));
  for (double factor : {0x1p-1000, 0x1p1000}) {
    const Outcome other = AtlasOf(SphereAndCube(factor, 4 * factor));
    EXPECT_EQ(other.atlas.wedge_texcoords, one.atlas.wedge_texcoords) << factor;
  }
  EXPECT_EQ(one.log.find("quality"), std::string::npos) << one.log;
}

TEST(DensityBy, ValuesThatAreNoDensityCountAsZeroAndAreLogged) {
  for (double wrong : {0.0, -1.0, -kInfinity, kInfinity, kNan}) {
    const Outcome outcome = AtlasOf(SphereAndCube(1, wrong));
    SCOPED_TRACE(wrong);
    ExpectRatio(outcome, 0.01);
    EXPECT_EQ(outcome.log.find("counts as 0") == std::string::npos, wrong == 0) << outcome.log;
  }
}

TEST(DensityBy, WithoutAnyQualityItIsUniformAndLogged) {
  const Outcome uniform = AtlasOf({}, DensityBy::kUniform);
  for (const auto& quality :
       {SphereAndCube(0, 0), SphereAndCube(kNan, -1), decltype(SphereAndCube(0, 0))()}) {
    const Outcome outcome = AtlasOf(quality);
    EXPECT_EQ(outcome.atlas.wedge_texcoords, uniform.atlas.wedge_texcoords);
    EXPECT_NE(outcome.log.find("No vertex has a quality above 0"), std::string::npos) << outcome.log;
  }
}

TEST(DensityBy, EqualQualityIsUniform) {
  const Outcome uniform = AtlasOf({}, DensityBy::kUniform), equal = AtlasOf(SphereAndCube(7, 7));
  EXPECT_EQ(equal.atlas.chart_ids, uniform.atlas.chart_ids);
  ExpectRatio(equal, 1);
}

TEST(DensityBy, UniformIgnoresQuality) {
  const Outcome without = AtlasOf({}, DensityBy::kUniform),
                with = AtlasOf(SphereAndCube(1, 5), DensityBy::kUniform);
  EXPECT_EQ(with.atlas.wedge_texcoords, without.atlas.wedge_texcoords);
  EXPECT_EQ(with.log, without.log);
}

TEST(DensityBy, AChartFollowsTheMeanOverItsArea) {
  // One flat chart with a dense half beside one of the dense half's quality: (0 + 2) / 2 to 1.
  SurfaceData mesh = shapes::Grid(20, 20);
  const SurfaceData other = mesh;
  const int count = static_cast<int>(mesh.vertices.size());
  double left = 1e300, right = -1e300;
  for (const auto& p : other.vertices) {
    left = std::min(left, p[0]);
    right = std::max(right, p[0]);
  }
  for (const auto& p : other.vertices) mesh.vertex_quality.push_back(2 * (p[0] - left) / (right - left));
  for (const auto& p : other.vertices) {
    mesh.vertices.push_back({p[0] + 2 * (right - left), p[1], p[2]});
    mesh.vertex_quality.push_back(1);
  }
  for (const auto& f : other.faces) mesh.faces.push_back({f[0] + count, f[1] + count, f[2] + count});
  Params params;
  params.density_by = DensityBy::kVertexQuality;
  Progress progress;
  const SurfaceChange atlas = TextureAtlas(mesh, params, progress);
  ASSERT_EQ(atlas.report.charts, 2);
  EXPECT_NEAR(*atlas.report.l2_stretch, 1, 1e-3);  // of the texture as a whole: both charts have one scale
}

}  // namespace
}  // namespace dcharts
