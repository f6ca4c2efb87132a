// SPDX-License-Identifier: GPL-3.0-or-later
/// The whole pipeline on every shape: what is promised of a finished atlas.
#include "dcharts.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "shapes.h"

namespace dcharts {
namespace {

using test::WrongInAtlas;

SurfaceChange Atlas(const SurfaceData& mesh, const Params& params = {}) {
  Progress progress;
  return TextureAtlas(mesh, params, progress);
}

/// A shape, coarse enough to be run many times.
struct Coarse {
  const char* name;
  SurfaceData (*make)();
};

const Coarse kCoarse[] = {
    {"grid", [] { return shapes::Grid(8, 6); }},
    {"disk", [] { return shapes::Disk(5); }},
    {"plane_with_hole", [] { return shapes::PlaneWithHole(10); }},
    {"spherical_cap", [] { return shapes::SphericalCap(6, 1.4); }},
    {"saddle_ridge", [] { return shapes::SaddleRidge(10); }},
    {"moebius_strip", [] { return shapes::MoebiusStrip(30); }},
    {"cylinder", [] { return shapes::OpenCylinder(16); }},
    {"closed_cylinder", [] { return shapes::ClosedCylinder(16); }},
    {"frustum", [] { return shapes::OpenFrustum(16); }},
    {"open_cone", [] { return shapes::OpenCone(16); }},
    {"closed_cone", [] { return shapes::ClosedCone(16); }},
    {"cube", [] { return shapes::Cube(4); }},
    {"sphere", [] { return shapes::Sphere(5); }},
    {"torus", [] { return shapes::Torus(10); }},
    {"double_torus", [] { return shapes::DoubleTorus(32); }},
    {"cad_part", [] { return shapes::CadPart(24); }},
    {"plush", [] { return shapes::Plush(32); }},
    {"two_components", [] { return shapes::TwoComponents(3); }},
    {"bow_tie", [] { return shapes::BowTie(4); }},
    {"non_manifold_fin", [] { return shapes::NonManifoldFin(4); }},
};

class EveryShape : public testing::TestWithParam<Coarse> {};

INSTANTIATE_TEST_SUITE_P(Pipeline, EveryShape, testing::ValuesIn(kCoarse),
                         [](const testing::TestParamInfo<Coarse>& shape) { return shape.param.name; });

TEST_P(EveryShape, AtlasIsSoundAtAnyChartCount) {
  const SurfaceData mesh = GetParam().make();
  for (int count : {0, 1, 2, 7, 30})
    for (bool to_disk : {false, true}) {
      SCOPED_TRACE("chart_count " + std::to_string(count) + (to_disk ? ", cut_to_disk" : ""));
      Params params;
      params.chart_count = count;
      params.cut_to_disk = to_disk;
      EXPECT_EQ(WrongInAtlas(mesh, Atlas(mesh, params), to_disk), "");
    }
}

}  // namespace
}  // namespace dcharts
