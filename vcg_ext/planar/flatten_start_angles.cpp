// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/flatten_start_angles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planar/boundary_loops.h"

namespace dcharts {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSmallestAngle = 2 * kPi / 180;
constexpr double kLargestAngle = kPi - 2 * kSmallestAngle;
constexpr double kLargestUpdate = 0.5;  // of an angle itself, per step
constexpr double kRegularization = 1e-10;

using Angles = std::vector<std::array<double, 3>>;  // per triangle and corner

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

// Corner angles, kept away from 0 and pi, each triangle's with the sum pi.
void Normalize(std::array<double, 3>& angles) {
  double sum = 0;
  for (double& angle : angles) {
    angle = std::min(std::max(angle, kSmallestAngle), kLargestAngle);
    sum += angle;
  }
  for (double& angle : angles) angle *= kPi / sum;
}

Angles AnglesOf(const RestShapes& shapes) {
  Angles angles(shapes.size());
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    // The gradient of corner k's hat function is normal to the opposite edge, so angles between edges are
    // pi minus angles between gradients, of which a_k are the mirrored halves.
    const Complex a[3] = {-shapes[t].a1 - shapes[t].a2, shapes[t].a1, shapes[t].a2};
    for (int k = 0; k < 3; ++k) {
      const Complex &x = a[(k + 1) % 3], &y = a[(k + 2) % 3];
      angles[t][At(k)] = kPi - std::atan2(std::abs(Cross(x, y)), Dot(x, y));
    }
    Normalize(angles[t]);
  }
  return angles;
}

// One Newton step of ABF: the least squared relative change of the angles after which the linearized
// conditions hold. These are: pi per triangle, 2 pi around an interior vertex, and edge lengths that agree
// around it. The triangles' conditions are eliminated; two unknowns per interior vertex remain.
bool AngleStep(const Triangles& triangles, const std::vector<char>& on_boundary, const Angles& wanted,
               Angles& angles, VertexBlockSystem& system) {
  const std::size_t vertex_count = on_boundary.size();
  PlanePoints residual(vertex_count, Complex(0, 0));
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (!on_boundary[v]) residual[v] = {2 * kPi, 0};
  }
  system.SetZero();
  // Row pair of corner k: coefficients of the three angle changes in the sum and in the length condition.
  const auto row = [&](const std::array<double, 3>& angle, int k, int corner) {
    if (corner == k) return Complex(1, 0);
    const double cotangent = 1 / std::tan(angle[At(corner)]);
    return Complex(0, corner == (k + 1) % 3 ? cotangent : -cotangent);
  };
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const std::array<double, 3>& angle = angles[At(t)];
    std::array<double, 3> d, toward;  // squared weights, and the way back to the wanted angles
    double d_sum = 0, rest = kPi;
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = wanted[At(t)][k] * wanted[At(t)][k];
      toward[k] = wanted[At(t)][k] - angle[k];
      d_sum += d[k];
      rest -= angle[k] + toward[k];
    }
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = At(triangles(t, k));
      if (on_boundary[v]) continue;
      residual[v] -= Complex(angle[At(k)], std::log(std::sin(angle[At((k + 1) % 3)])) -
                                               std::log(std::sin(angle[At((k + 2) % 3)])));
      Complex weighted(0, 0);
      for (int i = 0; i < 3; ++i) {
        const Complex c = row(angle, k, i);
        residual[v] -= c * toward[At(i)];
        weighted += c * d[At(i)];
      }
      residual[v] -= weighted * (rest / d_sum);
      for (int l = k; l < 3; ++l) {
        if (on_boundary[At(triangles(t, l))]) continue;
        Complex other_weighted(0, 0);
        Block2 block;
        for (int i = 0; i < 3; ++i) {
          const Complex c = row(angle, k, i), e = row(angle, l, i);
          const double w = d[At(i)];
          other_weighted += e * w;
          block.m00 += w * c.real() * e.real();
          block.m01 += w * c.real() * e.imag();
          block.m10 += w * c.imag() * e.real();
          block.m11 += w * c.imag() * e.imag();
        }
        block.m00 -= weighted.real() * other_weighted.real() / d_sum;
        block.m01 -= weighted.real() * other_weighted.imag() / d_sum;
        block.m10 -= weighted.imag() * other_weighted.real() / d_sum;
        block.m11 -= weighted.imag() * other_weighted.imag() / d_sum;
        system.Add(t, k, l, block);
      }
    }
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (on_boundary[v]) system.AddDiagonal(static_cast<Eigen::Index>(v), 1);
  }
  system.Regularize(kRegularization);
  if (!system.Factorize()) return false;
  const PlanePoints multiplier = system.Solve(residual);

  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const std::array<double, 3> angle = angles[At(t)];
    std::array<double, 3> change;
    double d_sum = 0, rest = kPi;
    for (int i = 0; i < 3; ++i) {
      const double d = wanted[At(t)][At(i)] * wanted[At(t)][At(i)];
      double pull = 0;
      for (int k = 0; k < 3; ++k) {
        const std::size_t v = At(triangles(t, k));
        if (!on_boundary[v]) pull += Dot(row(angle, k, i), multiplier[v]);
      }
      change[At(i)] = wanted[At(t)][At(i)] - angle[At(i)] + d * pull;
      d_sum += d;
      rest -= angle[At(i)] + change[At(i)];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      change[i] += wanted[At(t)][i] * wanted[At(t)][i] * rest / d_sum;
      if (!std::isfinite(change[i])) return false;
      const double bound = kLargestUpdate * angle[i];
      angles[At(t)][i] = angle[i] + std::min(std::max(change[i], -bound), bound);
    }
    Normalize(angles[At(t)]);
  }
  return true;
}

// Around an interior vertex the angles wanted are scaled so that they close.
void CloseAroundVertices(const Triangles& triangles, const std::vector<char>& on_boundary, Angles& wanted) {
  std::vector<double> sum(on_boundary.size(), 0.0);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) sum[At(triangles(t, k))] += wanted[At(t)][At(k)];
  }
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = At(triangles(t, k));
      if (!on_boundary[v]) wanted[At(t)][At(k)] *= 2 * kPi / sum[v];
    }
  }
}

// Two vertices far from each other: the one farthest from vertex 0, and the one farthest from that.
std::array<Eigen::Index, 2> FarVertices(const Points3& positions) {
  std::array<Eigen::Index, 2> far = {0, 0};
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::RowVector3d from = positions.row(far[0]);
    far[1] = far[0];
    (positions.rowwise() - from).rowwise().squaredNorm().maxCoeff(&far[0]);
  }
  if (far[0] == far[1]) far[1] = far[0] == 0 ? 1 : 0;
  return far;
}

}  // namespace

std::optional<PlanePoints> StartFromAngles(const ChartMesh& chart, const RestShapes& shapes, int angle_steps,
                                           VertexBlockSystem& system) {
  const Triangles& triangles = chart.triangles;
  const std::size_t vertex_count = At(chart.positions.rows());
  std::vector<char> on_boundary(vertex_count, 0);
  for (const std::vector<int>& loop : BoundaryLoops(triangles)) {
    for (const int v : loop) on_boundary[At(v)] = 1;
  }
  Angles angles = AnglesOf(shapes), wanted = angles;
  CloseAroundVertices(triangles, on_boundary, wanted);
  for (int step = 0; step < angle_steps; ++step) {
    if (!AngleStep(triangles, on_boundary, wanted, angles, system)) return std::nullopt;
  }

  // Least squares: sum of weight |beta|^2 over triangles with the angles found.
  system.SetZero();
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const std::array<double, 3>& angle = angles[At(t)];
    const RestShape shape = ShapeFromCorners(0, std::sin(angle[2]), std::polar(std::sin(angle[1]), angle[0]));
    // area times |beta|^2, which is the same for every size of the triangle
    const double weight = shape.twice_area;
    const Complex a[3] = {-shape.a1 - shape.a2, shape.a1, shape.a2};
    for (int k = 0; k < 3; ++k) {
      for (int l = k; l < 3; ++l) system.Add(t, k, l, BlockOf(weight * ConjMul(a[l], a[k]), Complex(0, 0)));
    }
  }
  const std::array<Eigen::Index, 2> far = FarVertices(chart.positions);
  PlanePoints right_hand_side(vertex_count, Complex(0, 0));
  const double distance = (chart.positions.row(far[0]) - chart.positions.row(far[1])).norm();
  system.Pin(far[0], Complex(0, 0), right_hand_side);
  system.Pin(far[1], Complex(distance > 0 ? distance : 1.0, 0), right_hand_side);
  if (!system.Factorize()) return std::nullopt;
  return system.Solve(right_hand_side);
}

}  // namespace dcharts
