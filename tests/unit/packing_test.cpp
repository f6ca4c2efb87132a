// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/pi.h"

namespace dcharts {
namespace {

// A closed polygon as the packer wants it: two rows per edge.
Points2 Outline(const std::vector<Eigen::Vector2d>& polygon) {
  Points2 outline(static_cast<Eigen::Index>(2 * polygon.size()), 2);
  for (size_t k = 0; k < polygon.size(); ++k) {
    outline.row(static_cast<Eigen::Index>(2 * k)) = polygon[k];
    outline.row(static_cast<Eigen::Index>(2 * k + 1)) = polygon[(k + 1) % polygon.size()];
  }
  return outline;
}

Points2 Box(double width, double height, double x = 0, double y = 0) {
  return Outline({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
}

Points2 Star(int corners, double radius, double inner, double turn, double x, double y) {
  std::vector<Eigen::Vector2d> polygon;
  for (int k = 0; k < 2 * corners; ++k) {
    const double a = turn + kPi * k / corners, r = k % 2 ? inner : radius;
    polygon.push_back({x + r * std::cos(a), y + r * std::sin(a)});
  }
  return Outline(polygon);
}

std::vector<Points2> RandomStars(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> size(0.1, 1), part(0.3, 1), angle(0, 6), place(-5, 5);
  std::vector<Points2> outlines;
  for (int k = 0; k < count; ++k) {
    const double r = size(random);
    outlines.push_back(Star(3 + k % 5, r, r * part(random), angle(random), place(random), place(random)));
  }
  return outlines;
}

Points2 Placed(const Points2& outline, const Packing& packing, size_t k) {
  const Placement& p = packing.placements[k];
  Eigen::Matrix2d turn;
  turn << std::cos(p.angle), -std::sin(p.angle), std::sin(p.angle), std::cos(p.angle);
  Points2 placed = packing.scale * outline * turn.transpose();
  placed.rowwise() += p.offset.transpose();
  return placed;
}

double PointToSegment(const Eigen::RowVector2d& p, const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-300), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

bool Cross(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b, const Eigen::RowVector2d& c,
           const Eigen::RowVector2d& d) {
  auto side = [](const auto& p, const auto& q, const auto& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

// Smallest distance between two outlines; 0 when they cross.
double Distance(const Points2& a, const Points2& b) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < a.rows(); i += 2)
    for (Eigen::Index j = 0; j < b.rows(); j += 2) {
      if (Cross(a.row(i), a.row(i + 1), b.row(j), b.row(j + 1))) return 0;
      least = std::min({least, PointToSegment(a.row(i), b.row(j), b.row(j + 1)),
                        PointToSegment(b.row(j), a.row(i), a.row(i + 1))});
    }
  return least;
}

bool Within(const Points2& polygon, const Eigen::RowVector2d& p) {
  bool inside = false;
  for (Eigen::Index e = 0; e < polygon.rows(); e += 2) {
    const Eigen::RowVector2d a = polygon.row(e), b = polygon.row(e + 1);
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

// In the unit square; no two nearer than the padding; none within another.
void ExpectSound(const std::vector<Points2>& outlines, const PackOptions& options, const Packing& packing) {
  ASSERT_EQ(packing.placements.size(), outlines.size());
  EXPECT_GT(packing.scale, 0);
  std::vector<Points2> placed;
  for (size_t k = 0; k < outlines.size(); ++k) {
    placed.push_back(Placed(outlines[k], packing, k));
    EXPECT_GE(placed.back().minCoeff(), 0) << k;
    EXPECT_LE(placed.back().maxCoeff(), 1) << k;
  }
  const double apart = packing.padding / options.texture_size;
  for (size_t i = 0; i < placed.size(); ++i)
    for (size_t j = i + 1; j < placed.size(); ++j) {
      const Eigen::RowVector2d low = placed[i].colwise().minCoeff(), high = placed[i].colwise().maxCoeff();
      if ((placed[j].colwise().minCoeff() - high).maxCoeff() > apart ||
          (low - placed[j].colwise().maxCoeff()).maxCoeff() > apart)
        continue;
      EXPECT_GE(Distance(placed[i], placed[j]), apart) << i << " and " << j;
      EXPECT_FALSE(Within(placed[i], placed[j].row(0)) || Within(placed[j], placed[i].row(0)))
          << i << " and " << j;
    }
}

double AreaOf(const Points2& outline) {
  double twice = 0;
  for (Eigen::Index e = 0; e < outline.rows(); e += 2)
    twice += outline(e, 0) * outline(e + 1, 1) - outline(e, 1) * outline(e + 1, 0);
  return std::abs(twice) / 2;
}

double Efficiency(const std::vector<Points2>& outlines, const Packing& packing) {
  double area = 0;
  for (const Points2& o : outlines) area += AreaOf(o);
  return area * packing.scale * packing.scale;
}

TEST(Packing, NothingToPack) { EXPECT_TRUE(Pack({}, {}).placements.empty()); }

TEST(Packing, OneSquareFillsTheTexture) {
  const std::vector<Points2> outlines{Box(7, 7, 100, -30)};
  const PackOptions options;
  const Packing packing = Pack(outlines, options);
  ExpectSound(outlines, options, packing);
  EXPECT_GT(Efficiency(outlines, packing), 0.95);
}

TEST(Packing, ATurnedSquareIsTurnedUpright) {
  const std::vector<Points2> outlines{Star(2, 1, 1, 0.4, 3, 3)};  // four corners
  const Packing packing = Pack(outlines, {});
  ExpectSound(outlines, {}, packing);
  EXPECT_GT(Efficiency(outlines, packing), 0.95);
}

TEST(Packing, ChartsAreApartByThePadding) {
  for (int padding : {0, 2, 17})
    for (int size : {256, 4096}) {
      const auto outlines = RandomStars(static_cast<unsigned>(padding + size), 15);
      const PackOptions options{size, padding, true};
      const Packing packing = Pack(outlines, options);
      SCOPED_TRACE("padding " + std::to_string(padding) + ", texture " + std::to_string(size));
      EXPECT_EQ(packing.padding, padding);
      ExpectSound(outlines, options, packing);
    }
}

TEST(Packing, WithoutRotationAnglesAreZero) {
  const auto outlines = RandomStars(4, 30);
  const PackOptions options{1024, 2, false};
  const Packing packing = Pack(outlines, options);
  ExpectSound(outlines, options, packing);
  for (const Placement& p : packing.placements) EXPECT_EQ(p.angle, 0);
}

TEST(Packing, RotationGainsRoom) {
  const std::vector<Points2> outlines{Star(2, 1, 1, 0, 0, 0)};  // a square on its tip
  const Packing turned = Pack(outlines, {1024, 2, true}), straight = Pack(outlines, {1024, 2, false});
  EXPECT_NEAR(Efficiency(outlines, straight), 0.5, 0.02);
  EXPECT_GT(turned.scale, 1.3 * straight.scale);
}

TEST(Packing, ManyTinyChartsBesideALargeOne) {
  auto outlines = RandomStars(9, 200);
  for (Points2& o : outlines) o *= 0.01;
  outlines.push_back(Star(6, 2, 1.5, 0.1, 0, 0));
  const PackOptions options{1024, 1, true};
  const Packing packing = Pack(outlines, options);
  ExpectSound(outlines, options, packing);
  EXPECT_GT(Efficiency(outlines, packing), 0.3);
}

TEST(Packing, PaddingGivesWayWhenThereIsNoRoom) {
  std::vector<Points2> outlines;
  for (int k = 0; k < 150; ++k) outlines.push_back(Box(1, 1));
  const PackOptions options{64, 6, true};  // 12 x 12 charts in 64 x 64 texels
  const Packing packing = Pack(outlines, options);
  EXPECT_LT(packing.padding, options.padding);
  EXPECT_GT(packing.scale, 0);
  ExpectSound(outlines, options, packing);
}

TEST(Packing, ScaleOfTheInputDoesNotMatter) {
  const auto outlines = RandomStars(12, 10);
  const double scale = Pack(outlines, {}).scale;
  for (double factor : {1e-9, 1e9}) {
    auto scaled = outlines;
    for (Points2& o : scaled) o *= factor;
    EXPECT_NEAR(Pack(scaled, {}).scale * factor / scale, 1, 1e-6) << factor;
  }
}

TEST(Packing, AHoleInAChart) {
  // A ring has room inside, which its profile doesn't show: the small one stays outside or clear of the rim.
  std::vector<Points2> outlines{Star(20, 1, 1, 0, 0, 0), Star(5, 0.2, 0.2, 0, 0, 0)};
  const Points2 hole = Star(20, 0.7, 0.7, 0, 0, 0);
  Points2 ring(outlines[0].rows() + hole.rows(), 2);
  ring << outlines[0], hole;
  outlines[0] = ring;
  const Packing packing = Pack(outlines, {});
  const Points2 a = Placed(outlines[0], packing, 0), b = Placed(outlines[1], packing, 1);
  EXPECT_GE(Distance(a, b), 2.0 / 1024);
}

TEST(Packing, OutlinesWithoutAreaHaveAPlace) {
  std::vector<Points2> outlines{Box(1, 1), Outline({{0, 0}, {1, 0}}), Outline({{2, 2}, {2, 2}, {2, 2}})};
  const Packing packing = Pack(outlines, {});
  for (size_t k = 0; k < outlines.size(); ++k) {
    const Points2 placed = Placed(outlines[k], packing, k);
    EXPECT_TRUE(placed.allFinite()) << k;
    EXPECT_GE(placed.minCoeff(), 0) << k;
    EXPECT_LE(placed.maxCoeff(), 1) << k;
  }
}

TEST(Packing, SmallTextureAndVeryLongChart) {
  for (int size : {16, 100, 65536}) {
    const std::vector<Points2> outlines{Box(1000, 0.5), Box(0.5, 300), Box(3, 3)};
    const PackOptions options{size, size == 16 ? 0 : 2, true};
    SCOPED_TRACE("texture " + std::to_string(size));
    ExpectSound(outlines, options, Pack(outlines, options));
  }
}

TEST(Packing, SameInputSameResult) {
  const auto outlines = RandomStars(31, 15);
  const Packing a = Pack(outlines, {}), b = Pack(outlines, {});
  EXPECT_EQ(a.scale, b.scale);
  for (size_t k = 0; k < outlines.size(); ++k) {
    EXPECT_EQ(a.placements[k].angle, b.placements[k].angle);
    EXPECT_EQ(a.placements[k].offset, b.placements[k].offset);
  }
}

}  // namespace
}  // namespace dcharts
