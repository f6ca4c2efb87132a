// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "common/pi.h"
#include "mesh_builder.h"
#include "shapes.h"

namespace dcharts::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// All lengths of the part; z = 0 is its underside.
constexpr double kPlateHeight = 0.3, kBossHeight = 0.75;
constexpr double kEdgeRadius = 0.08, kFootRadius = 0.12;
constexpr double kBossRadius = 0.34, kBoreRadius = 0.2, kBoltRadius = 0.11;

struct Corner {
  Vector2d at;
  double radius;
};

/// A point of the outline and the direction out of the part.
struct OutlinePoint {
  Vector2d at, normal;
};

/// Number of equal steps of about `step` in `length`.
int Steps(double length, double step) { return std::max(1, static_cast<int>(std::lround(length / step))); }

/// A counter-clockwise polygon with rounded corners, in steps of about `step`.
std::vector<OutlinePoint> RoundedOutline(const std::vector<Corner>& corners, double step) {
  std::vector<OutlinePoint> outline;
  const size_t n = corners.size();
  const auto direction = [&](size_t i) -> Vector2d {
    return (corners[(i + 1) % n].at - corners[i % n].at).normalized();
  };
  const auto turn = [&](size_t i) {  // at corner i, positive to the left
    const Vector2d in = direction(i + n - 1), out = direction(i);
    return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  };
  const auto trim = [&](size_t i) { return corners[i % n].radius * std::tan(std::abs(turn(i % n)) / 2); };
  for (size_t i = 0; i < n; ++i) {
    const Vector2d in = direction(i + n - 1), out = direction(i);
    const Vector2d normal_in(in.y(), -in.x()), normal_out(out.y(), -out.x());
    const double angle = turn(i), side = angle > 0 ? 1 : -1;
    const Vector2d arc_start = corners[i].at - trim(i) * in;
    const Vector2d centre = arc_start - side * corners[i].radius * normal_in;
    const int arc_steps = std::max(Steps(std::abs(angle) * corners[i].radius, step), 4);
    for (int k = 0; k < arc_steps; ++k) {
      const Vector2d normal = Eigen::Rotation2Dd(angle * k / arc_steps) * normal_in;
      outline.push_back({centre + side * corners[i].radius * normal, normal});
    }
    const Vector2d start = corners[i].at + trim(i) * out;
    const Vector2d end = corners[(i + 1) % n].at - trim(i + 1) * out;
    const int steps = Steps((end - start).norm(), step);
    for (int k = 0; k < steps; ++k)
      outline.push_back({start + static_cast<double>(k) / steps * (end - start), normal_out});
  }
  return outline;
}

std::vector<int> AddOutline(MeshBuilder& builder, const std::vector<OutlinePoint>& outline, double inset,
                            double z) {
  std::vector<int> ring;
  for (const auto& p : outline) {
    const Vector2d at = p.at - inset * p.normal;
    ring.push_back(builder.AddVertex(Vector3d(at.x(), at.y(), z)));
  }
  return ring;
}

/// Wall of a round hole, seen from within; returns the ring at its lower end.
std::vector<int> AddHoleWall(MeshBuilder& builder, const Vector2d& centre, double radius,
                             const std::vector<int>& upper_ring, double top, double step) {
  const int levels = Steps(top, step);
  std::vector<int> ring = upper_ring;
  for (int k = levels - 1; k >= 0; --k) {
    const std::vector<int> next =
        builder.AddRing(centre, radius, static_cast<int>(upper_ring.size()), top * k / levels);
    builder.AddBand(ring, next);
    ring = next;
  }
  return ring;
}

}  // namespace

SurfaceData CadPart(int n) {
  RequireAtLeast("The number of edges along the plate", n, 24);
  const double step = 2.0 / n;
  const std::vector<OutlinePoint> outline = RoundedOutline({{{0, 0}, 0.25},
                                                            {{2, 0}, 0.25},
                                                            {{2, 0.75}, 0.25},
                                                            {{1.3, 0.75}, 0.2},
                                                            {{1.1, 1.3}, 0.2},
                                                            {{0, 1.3}, 0.4}},
                                                           step);
  const Vector2d boss(0.58, 0.66);
  const std::vector<Vector2d> bolts{{1.72, 0.38}, {1.3, 0.3}};
  const auto round_steps = [step](double radius, double angle, int least) {
    return std::max(Steps(angle * radius, step), least);
  };

  MeshBuilder builder;
  // The outer wall, and the rounding over to the plate's top.
  const std::vector<int> bottom = AddOutline(builder, outline, 0, 0);
  std::vector<int> ring = bottom;
  const double wall = kPlateHeight - kEdgeRadius;
  const auto continue_to = [&](const std::vector<int>& next) {
    builder.AddBand(ring, next);
    ring = next;
  };
  const int wall_levels = Steps(wall, step);
  for (int k = 1; k <= wall_levels; ++k) continue_to(AddOutline(builder, outline, 0, wall * k / wall_levels));
  const int edge_levels = round_steps(kEdgeRadius, kPi / 2, 4);
  for (int k = 1; k <= edge_levels; ++k) {
    const double angle = kPi / 2 * k / edge_levels;
    continue_to(AddOutline(builder, outline, kEdgeRadius * (1 - std::cos(angle)),
                           wall + kEdgeRadius * std::sin(angle)));
  }
  std::vector<std::vector<int>> top{ring}, underside{bottom};

  // The boss: fillet at its foot, wall, flat top, bore.
  const int boss_sides = round_steps(kBossRadius + kFootRadius / 2, 2 * kPi, 24);
  ring = builder.AddRing(boss, kBossRadius + kFootRadius, boss_sides, kPlateHeight);
  top.push_back(ring);
  const int foot_levels = round_steps(kFootRadius, kPi / 2, 4);
  for (int k = 1; k <= foot_levels; ++k) {
    const double angle = kPi / 2 * k / foot_levels;
    continue_to(builder.AddRing(boss, kBossRadius + kFootRadius * (1 - std::sin(angle)), boss_sides,
                                kPlateHeight + kFootRadius * (1 - std::cos(angle))));
  }
  const double boss_wall = kBossHeight - kPlateHeight - kFootRadius;
  const int boss_levels = Steps(boss_wall, step);
  for (int k = 1; k <= boss_levels; ++k)
    continue_to(builder.AddRing(boss, kBossRadius, boss_sides,
                                kPlateHeight + kFootRadius + boss_wall * k / boss_levels));
  const std::vector<int> bore =
      builder.AddRing(boss, kBoreRadius, round_steps(kBoreRadius, 2 * kPi, 24), kBossHeight);
  builder.AddFlat({ring, bore}, step, Facing::kUp);
  underside.push_back(AddHoleWall(builder, boss, kBoreRadius, bore, kBossHeight, step));

  for (const Vector2d& bolt : bolts) {
    top.push_back(builder.AddRing(bolt, kBoltRadius, round_steps(kBoltRadius, 2 * kPi, 16), kPlateHeight));
    underside.push_back(AddHoleWall(builder, bolt, kBoltRadius, top.back(), kPlateHeight, step));
  }
  builder.AddFlat(top, step, Facing::kUp);
  builder.AddFlat(underside, step, Facing::kDown);
  return builder.Take();
}

}  // namespace dcharts::shapes
