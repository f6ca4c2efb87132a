// SPDX-License-Identifier: GPL-3.0-or-later
/// The whole pipeline on every shape: what is promised of a finished atlas.
#include "dcharts.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "coarse_shapes.h"
#include "shapes.h"

namespace dcharts {
namespace {

using test::Coarse;
using test::kCoarse;
using test::WrongInAtlas;

SurfaceChange Atlas(const SurfaceData& mesh, const Params& params = {}) {
  Progress progress;
  return TextureAtlas(mesh, params, progress);
}

class EveryShape : public testing::TestWithParam<Coarse> {};

INSTANTIATE_TEST_SUITE_P(Pipeline, EveryShape, testing::ValuesIn(kCoarse),
                         [](const testing::TestParamInfo<Coarse>& shape) { return shape.param.name; });

TEST_P(EveryShape, AtlasIsSoundAtAnyChartCount) {
  const SurfaceData mesh = GetParam().make();
  const std::pair<int, bool> cases[] = {{0, false}, {0, true}, {1, true}, {2, false}, {7, true}, {30, false}};
  for (const auto& [count, to_disk] : cases) {
    SCOPED_TRACE("chart_count " + std::to_string(count) + (to_disk ? ", cut_to_disk" : ""));
    Params params;
    params.chart_count = count;
    params.cut_to_disk = to_disk;
    EXPECT_EQ(WrongInAtlas(mesh, Atlas(mesh, params), to_disk), "");
  }
}

// Developable shapes come out without stretch, with the default parameters.
class ExactShape : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Pipeline, ExactShape,
                         testing::Values("grid", "disk", "plane_with_hole", "cylinder", "closed_cylinder",
                                         "frustum", "open_cone", "closed_cone", "cube", "bow_tie",
                                         "non_manifold_fin"),
                         [](const testing::TestParamInfo<const char*>& shape) { return shape.param; });

TEST_P(ExactShape, HasNoStretch) {
  const SurfaceData mesh = shapes::ShapeByName(GetParam()).mesh;
  for (bool to_disk : {false, true}) {
    Params params;
    params.cut_to_disk = to_disk;
    const SurfaceChange atlas = Atlas(mesh, params);
    EXPECT_EQ(WrongInAtlas(mesh, atlas, to_disk), "");
    // A slit in a flat part is opened visibly, which takes a little stretch.
    const double tolerance = to_disk ? 0.2 : 1e-4;
    EXPECT_NEAR(*atlas.report.l2_stretch, 1, to_disk ? 0.01 : 1e-4) << to_disk;
    EXPECT_NEAR(*atlas.report.linf_stretch, 1, tolerance) << to_disk;
    EXPECT_NEAR(*atlas.report.l2_shear, 0, to_disk ? 0.01 : 1e-4) << to_disk;
  }
}

TEST(Pipeline, PlanesAndDisksAreOneChartWithoutSeams) {
  for (const char* name : {"grid", "disk", "plane_with_hole"}) {
    const SurfaceChange atlas = Atlas(shapes::ShapeByName(name).mesh);
    EXPECT_EQ(atlas.report.charts, 1) << name;
    EXPECT_EQ(atlas.report.seam_length, 0.0) << name;
    EXPECT_EQ(atlas.report.darts, 0) << name;
  }
}

// One cut along the axis, nothing more: it is as long as the prism is high.
TEST(Pipeline, OpenCylinderIsOneChartWithOneCut) {
  const SurfaceData mesh = shapes::OpenCylinder();
  const SurfaceChange atlas = Atlas(mesh);
  EXPECT_EQ(atlas.report.charts, 1);
  EXPECT_NEAR(*atlas.report.seam_length, 1 / std::sqrt(test::TotalArea(mesh)), 1e-9);
}

// The flat faces of a machined part, painted as charts, keep their shape exactly beside those that can't.
TEST(Pipeline, FlatFacesOfAPartHaveNoStretch) {
  SurfaceData mesh = shapes::CadPart(32);
  const std::vector<int> opposite = test::Opposites(mesh);
  auto normal = [&](int f) {
    const test::Vec3& a = mesh.vertices[mesh.faces[f][0]];
    test::Vec3 n = test::Cross(test::Minus(mesh.vertices[mesh.faces[f][1]], a),
                               test::Minus(mesh.vertices[mesh.faces[f][2]], a));
    const double length = test::Norm(n);
    for (double& x : n) x /= length;
    return n;
  };
  test::Sets flat(mesh.faces.size());
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h)
    if (opposite[h] >= 0 && test::Dot(normal(h / 3), normal(opposite[h] / 3)) > 1 - 1e-12)
      flat.Join(h / 3, opposite[h] / 3);
  std::map<int, int> size;
  for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f) ++size[flat.Find(f)];
  std::set<int> large;
  for (const auto& [root, count] : size)
    if (count >= 20) large.insert(root);
  ASSERT_GE(large.size(), 4u);
  for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f)
    mesh.face_quality.push_back(large.count(flat.Find(f)) ? 1 + flat.Find(f) : 0);

  Progress progress;
  const SurfaceChange atlas = Parameterize(mesh, Params(), progress);
  EXPECT_EQ(WrongInAtlas(mesh, atlas, false), "");
  int alone = 0;
  for (int root : large) {
    // Where an overlap was cut off, a flat chart may have taken in a part of its neighbour.
    const int id = atlas.chart_ids[root];
    bool is_alone = true;
    for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f)
      is_alone &= atlas.chart_ids[f] != id || flat.Find(f) == root;
    if (!is_alone) continue;
    ++alone;
    SurfaceData part;
    part.vertices = mesh.vertices;
    std::vector<std::array<float, 6>> uv;
    for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f)
      if (flat.Find(f) == root) {
        part.faces.push_back(mesh.faces[f]);
        uv.push_back(atlas.wedge_texcoords[f]);
      }
    const test::Stretch stretch = test::StretchOf(part, uv);
    EXPECT_NEAR(stretch.l2, 1, 1e-4) << part.faces.size() << " faces";
    EXPECT_NEAR(stretch.linf, 1, 1e-4) << part.faces.size() << " faces";
  }
  EXPECT_GE(alone, 4);
}

TEST(Pipeline, ColorsFollowChartIds) {
  const SurfaceData mesh = shapes::Cube(3);
  const SurfaceChange atlas = Atlas(mesh);
  std::map<int, std::array<std::uint8_t, 3>> color;
  for (size_t f = 0; f < mesh.faces.size(); ++f)
    EXPECT_EQ(color.emplace(atlas.chart_ids[f], atlas.colors[f]).first->second, atlas.colors[f]);
  std::set<std::array<std::uint8_t, 3>> different;
  for (const auto& entry : color) different.insert(entry.second);
  EXPECT_EQ(different.size(), color.size());
}

TEST(Pipeline, SeamLinesAreTheSeams) {
  const SurfaceData mesh = shapes::OpenCylinder(12);
  Params params;
  EXPECT_TRUE(Atlas(mesh, params).seam_lines.empty());
  params.seam_layer = true;
  const SurfaceChange atlas = Atlas(mesh, params);
  double length = 0;
  for (const auto& line : atlas.seam_lines) length += test::Norm(test::Minus(line[0], line[1]));
  EXPECT_GT(length, 0);
  EXPECT_NEAR(length / std::sqrt(test::TotalArea(mesh)), *atlas.report.seam_length, 1e-9);
}

}  // namespace
}  // namespace dcharts
