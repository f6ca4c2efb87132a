// SPDX-License-Identifier: GPL-3.0-or-later
/// The checks of atlases themselves: how far figures may differ.
#include "atlas_checks.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "shapes.h"

namespace dcharts {
namespace {

// Two short needles far apart, in one plane: their heights have few digits of coordinates of this size.
SurfaceData Needles(double length, double height, double x, double y) {
  SurfaceData mesh;
  for (const double at : {0.0, 1.0}) {
    const int first = static_cast<int>(mesh.vertices.size());
    const double left = at + 0.1 * x, low = 0.7 * at + 0.1 * y;
    mesh.vertices.push_back({left, low, 0});
    mesh.vertices.push_back({left + length, low, 0});
    mesh.vertices.push_back({left + 0.4 * length, low + height, 0});
    mesh.faces.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

SurfaceData MovedAndScaled(SurfaceData mesh) {
  for (auto& p : mesh.vertices) p = {(p[0] - 0.5321) * 1.7, (p[1] - 0.377) * 1.7, p[2]};
  return mesh;
}

// The fuzzer told figures of such meshes as wrong, which only had been rounded in another way.
TEST(AtlasChecks, AllowFiguresWhatRoundingMakes) {
  std::mt19937 random(1);
  const auto real = [&] { return static_cast<double>(random()) / 4294967296.0; };
  constexpr float kStep = 1 / 16777216.0f;
  const std::vector<std::array<float, 6>> uv = {{0, 0.25f, 0.5f, 0.25f, 0.25f, 0.25f + kStep},
                                                {0, 0.75f, 0.5f, 0.75f, 0.25f, 0.75f + kStep}};
  for (int k = 0; k < 5000; ++k) {
    const double length = std::pow(10, -1 - 3 * real()), height = 2.2e-14 / length * (1 + 4 * real());
    const double x = real(), y = real();
    const SurfaceData mesh = Needles(length, height, x, y);
    const test::Stretch one = test::StretchOf(mesh, uv), other = test::StretchOf(MovedAndScaled(mesh), uv);
    ASSERT_LT(std::abs(one.l2 - other.l2), (1e-6 + one.uncertain) * one.l2) << length << " " << height;
    ASSERT_LT(std::abs(one.linf - other.linf), (1e-6 + one.uncertain) * one.linf) << length << " " << height;
  }
}

TEST(AtlasChecks, AreStrictWithOrdinaryShapes) {
  const SurfaceData mesh = shapes::Torus(12);
  const std::vector<std::array<float, 6>> uv(mesh.faces.size(), {0, 0, 1, 0, 0, 1});
  EXPECT_LT(test::StretchOf(mesh, uv).uncertain, 1e-10);
}

}  // namespace
}  // namespace dcharts
