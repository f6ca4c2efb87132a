// SPDX-License-Identifier: GPL-3.0-or-later
/// Charts that lap over themselves in the plane are drawn apart.
#include "planar/lay_apart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "common/pi.h"
#include "planar/distortion.h"
#include "planar/overlap.h"
#include "planar/trial_flatten.h"

namespace dcharts {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

// A flat ring, cut open, that goes round by so many degrees: what is more than 360 laps over. In space it
// rises a little, as a screw does.
ChartMesh Screw(double degrees, int across) {
  constexpr double kInner = 1, kOuter = 1.3, kRise = 0.02;
  const int along = static_cast<int>(degrees / 360 * 20 * across);
  ChartMesh mesh;
  mesh.positions.resize((along + 1) * (across + 1), 3);
  for (int i = 0; i <= along; ++i)
    for (int j = 0; j <= across; ++j) {
      const double angle = degrees / 180 * kPi * i / along, r = kInner + (kOuter - kInner) * j / across;
      mesh.positions.row(i * (across + 1) + j) << r * std::cos(angle), r * std::sin(angle), kRise * angle;
    }
  mesh.triangles.resize(2 * along * across, 3);
  int t = 0;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const int a = i * (across + 1) + j, b = a + across + 1;
      mesh.triangles.row(t++) << a, a + 1, b;
      mesh.triangles.row(t++) << a + 1, b + 1, b;
    }
  return mesh;
}

bool Overlaps(const ChartMesh& mesh, const Points2& uv) { return OverlapsItself(uv, mesh.triangles); }

TEST(LayApart, ARingThatIsALittleTooLongOpens) {
  constexpr int kLarge = 30;
  ASSERT_GT(Screw(363, kLarge).triangles.rows(), 30000);
  for (const auto& [degrees, across] : {std::pair{364, 3}, std::pair{364, 6}, std::pair{363, kLarge}}) {
    const ChartMesh mesh = Screw(degrees, across);
    const TrialFlattening flat = TrialFlatten(mesh);
    ASSERT_TRUE(flat.ok);
    ASSERT_TRUE(Overlaps(mesh, flat.uv));
    const auto apart = LayApart(mesh, flat.uv, kNoBound, ApartMapFor::kAtlas, [] {});
    ASSERT_TRUE(apart.has_value());
    EXPECT_FALSE(Overlaps(mesh, apart->uv));
    const StretchFigures figures = MeasureStretch(mesh, apart->uv);
    EXPECT_EQ(figures.FlippedOrDegenerate(), 0);
    EXPECT_NEAR(figures.L2(), apart->l2_stretch, 1e-9);
    EXPECT_NEAR(figures.UvArea(), figures.SurfaceArea(), 1e-9);
    EXPECT_GE(apart->l2_stretch, flat.l2_stretch - 1e-4);
    EXPECT_LT(apart->l2_stretch, 1.005);
    EXPECT_LT(apart->linf_stretch, 1.6);
    const auto measured = LayApart(mesh, flat.uv, kNoBound, ApartMapFor::kMeasuring, [] {});
    ASSERT_TRUE(measured.has_value());
    EXPECT_FALSE(Overlaps(mesh, measured->uv));
    EXPECT_LT(measured->l2_stretch, 1.005);
    EXPECT_GE(measured->linf_stretch, apart->linf_stretch);
  }
}

TEST(LayApart, KeepsWithinTheBound) {
  const ChartMesh mesh = Screw(364, 4);
  const TrialFlattening flat = TrialFlatten(mesh);
  const auto apart = LayApart(mesh, flat.uv, kNoBound, ApartMapFor::kAtlas, [] {});
  ASSERT_TRUE(apart.has_value());
  EXPECT_TRUE(LayApart(mesh, flat.uv, apart->l2_stretch + 1e-9, ApartMapFor::kAtlas, [] {}).has_value());
  EXPECT_FALSE(LayApart(mesh, flat.uv, apart->l2_stretch - 1e-6, ApartMapFor::kAtlas, [] {}).has_value());
}

TEST(LayApart, GivesUpWhereMuchLiesOnTop) {
  const ChartMesh mesh = Screw(600, 4);
  const TrialFlattening flat = TrialFlatten(mesh);
  ASSERT_TRUE(flat.ok);
  EXPECT_FALSE(LayApart(mesh, flat.uv, 1.01, ApartMapFor::kAtlas, [] {}).has_value());
}

TEST(LayApart, LeavesWhatDoesNotOverlap) {
  const ChartMesh mesh = Screw(300, 4);
  const TrialFlattening flat = TrialFlatten(mesh);
  ASSERT_FALSE(Overlaps(mesh, flat.uv));
  const auto apart = LayApart(mesh, flat.uv, kNoBound, ApartMapFor::kAtlas, [] {});
  ASSERT_TRUE(apart.has_value());
  EXPECT_FALSE(Overlaps(mesh, apart->uv));
  EXPECT_NEAR(apart->l2_stretch, flat.l2_stretch, 1e-4);
}

TEST(LayApart, CanBeStopped) {
  struct Stop {};
  const ChartMesh mesh = Screw(364, 4);
  const TrialFlattening flat = TrialFlatten(mesh);
  EXPECT_THROW(LayApart(mesh, flat.uv, kNoBound, ApartMapFor::kAtlas, [] { throw Stop(); }), Stop);
}

}  // namespace
}  // namespace dcharts
