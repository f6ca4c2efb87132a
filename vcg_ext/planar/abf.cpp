// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/abf.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "common/pi.h"
#include "planar/boundary_loops.h"

namespace dcharts {
namespace {

constexpr double kLargestUpdate = 0.5;    // of an angle itself, per step
constexpr double kLeastCurvature = 0.25;  // of the objective's own; keeps the Hessian positive
constexpr double kRegularization = 1e-10;
constexpr double kFillVariance = 1e4;  // of triangles that fill holes, in that of the chart's own

// Of the conformal map:
constexpr double kSmallestAngle = 1e-4;  // radians; slivers have rest shapes about as thin
constexpr int kMostSteps = 20;
constexpr double kConverged = 1e-7;   // relative step; Newton's next one would be rounding noise
constexpr double kGoodEnough = 1e-2;  // after the last step

using Corners = std::array<double, 3>;

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

// Corner angles, kept away from 0 and pi, with the sum pi.
void Normalize(double smallest, Corners& angles) {
  double sum = 0;
  for (double& angle : angles) {
    angle = std::min(std::max(angle, smallest), kPi - 2 * smallest);
    sum += angle;
  }
  for (double& angle : angles) angle *= kPi / sum;
}

Corners AnglesOf(const RestShape& shape) {
  // The gradient of corner k's hat function is normal to the opposite edge, so angles between edges are
  // pi minus angles between gradients, of which a_k are the mirrored halves.
  const Complex a[3] = {-shape.a1 - shape.a2, shape.a1, shape.a2};
  const auto angle = [&](int k) {
    const Complex &x = a[(k + 1) % 3], &y = a[(k + 2) % 3];
    return kPi - std::atan2(std::abs(Cross(x, y)), Dot(x, y));
  };
  Corners angles{angle(0), angle(1), 0};
  angles[2] = kPi - angles[0] - angles[1];
  return angles;
}

// What is left of q when the triangle's own condition is eliminated: d_i (q_i - mean of q weighted with d).
// Written with differences, because d q alone may be far larger in a triangle with an angle near pi.
template <class T>
std::array<T, 3> Project(const Corners& d, const std::array<T, 3>& q) {
  const double sum = d[0] + d[1] + d[2];
  std::array<T, 3> projected;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    projected[i] = (d[j] * (q[i] - q[j]) + d[k] * (q[i] - q[k])) * (d[i] / sum);
  }
  return projected;
}

// Around an interior vertex the angles wanted are scaled so that they close.
void CloseAroundVertices(const Triangles& triangles, const std::vector<char>& on_boundary,
                         std::vector<Corners>& wanted) {
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

std::vector<double> EdgeLengths(const Points3& positions, const std::vector<int>& loop) {
  std::vector<double> lengths(loop.size());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    lengths[i] = (positions.row(loop[(i + 1) % loop.size()]) - positions.row(loop[i])).norm();
  }
  return lengths;
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

bool HasNoFlip(const Triangles& triangles, const PlanePoints& uv) {
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Complex z0 = uv[At(triangles(t, 0))];
    if (!(Cross(uv[At(triangles(t, 1))] - z0, uv[At(triangles(t, 2))] - z0) > 0)) return false;
  }
  return true;
}

}  // namespace

AngleFlattening::AngleFlattening(const ChartMesh& chart, const RestShapes& shapes, double smallest_angle,
                                 int relative, bool fill_holes)
    : chart_(chart), triangles_(chart.triangles), smallest_angle_(smallest_angle), relative_(relative) {
  on_boundary_.assign(At(chart.positions.rows()), 0);
  const std::vector<std::vector<int>> loops = BoundaryLoops(chart.triangles);
  for (const std::vector<int>& loop : loops) {
    for (const int v : loop) on_boundary_[At(v)] = 1;
  }
  angles_.reserve(shapes.size());
  for (const RestShape& shape : shapes) {
    angles_.push_back(AnglesOf(shape));
    Normalize(smallest_angle_, angles_.back());
  }
  wanted_ = angles_;
  CloseAroundVertices(chart.triangles, on_boundary_, wanted_);
  if (fill_holes) FillHoles(loops);
  multiplier_.assign(on_boundary_.size(), Complex(0, 0));
}

void AngleFlattening::FillHoles(const std::vector<std::vector<int>>& loops) {
  std::vector<std::vector<double>> lengths;
  std::size_t outer = 0;
  Eigen::Index fans = 0;
  double longest = -1;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    lengths.push_back(EdgeLengths(chart_.positions, loops[i]));
    const double length = std::accumulate(lengths[i].begin(), lengths[i].end(), 0.0);
    if (length > longest) longest = length, outer = i;
    fans += static_cast<Eigen::Index>(loops[i].size());
  }
  Eigen::Index t = triangles_.rows();
  triangles_.conservativeResize(t + fans - static_cast<Eigen::Index>(loops[outer].size()), 3);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (i == outer) continue;
    const int middle = static_cast<int>(on_boundary_.size());
    on_boundary_.push_back(0);
    const double around = std::accumulate(lengths[i].begin(), lengths[i].end(), 0.0);
    for (std::size_t k = 0; k < loops[i].size(); ++k) {
      const int v = loops[i][k], next = loops[i][(k + 1) % loops[i].size()];
      on_boundary_[At(v)] = 0;
      triangles_.row(t++) << next, v, middle;
      // of a circle
      const double tip = around > 0 ? 2 * kPi * lengths[i][k] / around : 2 * kPi / At(loops[i].size());
      angles_.push_back({0.5 * (kPi - tip), 0.5 * (kPi - tip), tip});
      Normalize(smallest_angle_, angles_.back());
      wanted_.push_back(angles_.back());
    }
  }
}

// Of an angle, as it were: what its change counts is one over it.
double AngleFlattening::Variance(Eigen::Index triangle, int corner) const {
  const double wanted = wanted_[At(triangle)][At(corner)];
  const double variance = relative_ == 2 ? wanted * wanted : wanted;
  return triangle < chart_.triangles.rows() ? variance : kFillVariance * variance;
}

// What a change of the angle at `corner` does to the conditions of the vertex at corner k: to the sum of
// angles (real part) and to the logarithm of the product of sines (imaginary part).
Complex AngleFlattening::Row(const Corners& cotangent, int k, int corner) {
  if (corner == k) return {1, 0};
  return {0, corner == (k + 1) % 3 ? cotangent[At(corner)] : -cotangent[At(corner)]};
}

// The inverse of the Lagrangian's Hessian. The objective gives 1 / variance, a length condition its
// multiplier over the squared sine.
Corners AngleFlattening::Compliance(Eigen::Index triangle, const Corners& sine) const {
  Corners compliance;
  for (int i = 0; i < 3; ++i) {
    const double variance = Variance(triangle, i);
    double pull = 0;
    for (const int k : {(i + 1) % 3, (i + 2) % 3}) {
      const std::size_t v = At(triangles_(triangle, k));
      if (!on_boundary_[v]) pull += (i == (k + 1) % 3 ? 1 : -1) * multiplier_[v].imag();
    }
    const double curvature = 1 + variance / (sine[At(i)] * sine[At(i)]) * pull;
    compliance[At(i)] = variance / std::max(curvature, kLeastCurvature);
  }
  return compliance;
}

bool AngleFlattening::Step(VertexBlockSystem& system) {
  const std::size_t vertex_count = on_boundary_.size();
  PlanePoints residual(vertex_count, Complex(0, 0));
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (!on_boundary_[v]) residual[v] = {2 * kPi, 0};
  }
  std::vector<Corners> compliances(angles_.size()), changes(angles_.size()), cotangents(angles_.size());
  system.SetZero();
  for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
    const Corners& angle = angles_[At(t)];
    Corners sine, log_sine;
    for (std::size_t i = 0; i < 3; ++i) {
      sine[i] = std::sin(angle[i]);
      log_sine[i] = std::log(sine[i]);
      cotangents[At(t)][i] = std::cos(angle[i]) / sine[i];
    }
    const Corners d = compliances[At(t)] = Compliance(t, sine);
    const double rest = kPi - angle[0] - angle[1] - angle[2], sum = d[0] + d[1] + d[2];
    Corners toward;  // what the objective alone would do
    for (std::size_t i = 0; i < 3; ++i) {
      toward[i] = (wanted_[At(t)][i] - angle[i]) / Variance(t, static_cast<int>(i));
    }
    toward = Project(d, toward);
    for (std::size_t i = 0; i < 3; ++i) toward[i] += d[i] / sum * rest;
    changes[At(t)] = toward;

    std::array<Complex, 3> rows[3], projected[3];
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) rows[k][At(i)] = Row(cotangents[At(t)], k, i);
      projected[k] = Project(d, rows[k]);
    }
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = At(triangles_(t, k));
      if (on_boundary_[v]) continue;
      residual[v] -= Complex(angle[At(k)], log_sine[At((k + 1) % 3)] - log_sine[At((k + 2) % 3)]);
      for (std::size_t i = 0; i < 3; ++i) residual[v] -= rows[k][i] * toward[i];
      for (int l = k; l < 3; ++l) {
        if (on_boundary_[At(triangles_(t, l))]) continue;
        Block2 block;
        // The differences of rows, because the sum of their products cancels.
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t j = (i + 1) % 3;
          const Complex c = rows[k][i] - rows[k][j], e = rows[l][i] - rows[l][j];
          const double w = d[i] * (d[j] / sum);
          block.m00 += w * c.real() * e.real();
          block.m01 += w * c.real() * e.imag();
          block.m10 += w * c.imag() * e.real();
          block.m11 += w * c.imag() * e.imag();
        }
        system.Add(t, k, l, block);
      }
    }
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (on_boundary_[v]) system.AddDiagonal(static_cast<Eigen::Index>(v), 1);
  }
  system.Regularize(kRegularization);
  if (!system.Factorize()) return false;
  const PlanePoints multiplier = system.Solve(residual);

  for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
    Corners pull;
    for (int i = 0; i < 3; ++i) {
      pull[At(i)] = 0;
      for (int k = 0; k < 3; ++k) {
        const std::size_t v = At(triangles_(t, k));
        if (!on_boundary_[v]) pull[At(i)] += Dot(Row(cotangents[At(t)], k, i), multiplier[v]);
      }
    }
    pull = Project(compliances[At(t)], pull);
    for (std::size_t i = 0; i < 3; ++i) {
      changes[At(t)][i] += pull[i];
      if (!std::isfinite(changes[At(t)][i])) return false;
    }
  }
  double squares = 0;
  for (std::size_t t = 0; t < angles_.size(); ++t) {
    const Corners before = angles_[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const double bound = kLargestUpdate * before[i];
      angles_[t][i] += std::min(std::max(changes[t][i], -bound), bound);
    }
    Normalize(smallest_angle_, angles_[t]);
    for (std::size_t i = 0; i < 3; ++i) {
      const double moved = (angles_[t][i] - before[i]) / wanted_[t][i];
      squares += moved * moved;
    }
  }
  multiplier_ = multiplier;
  last_step_ = std::sqrt(squares / (3 * static_cast<double>(angles_.size())));
  return true;
}

std::optional<PlanePoints> AngleFlattening::LayOut(VertexBlockSystem& system) const {
  const Triangles& triangles = chart_.triangles;
  // Least squares: sum of weight |beta|^2 over triangles with the angles found.
  system.SetZero();
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Corners& angle = angles_[At(t)];
    const RestShape shape = ShapeFromCorners(0, std::sin(angle[2]), std::polar(std::sin(angle[1]), angle[0]));
    // area times |beta|^2, which is the same for every size of the triangle
    const double weight = shape.twice_area;
    const Complex a[3] = {-shape.a1 - shape.a2, shape.a1, shape.a2};
    for (int k = 0; k < 3; ++k) {
      for (int l = k; l < 3; ++l) system.Add(t, k, l, BlockOf(weight * ConjMul(a[l], a[k]), Complex(0, 0)));
    }
  }
  const std::array<Eigen::Index, 2> far = FarVertices(chart_.positions);
  PlanePoints right_hand_side(At(chart_.positions.rows()), Complex(0, 0));
  const double distance = (chart_.positions.row(far[0]) - chart_.positions.row(far[1])).norm();
  system.Pin(far[0], Complex(0, 0), right_hand_side);
  system.Pin(far[1], Complex(distance > 0 ? distance : 1.0, 0), right_hand_side);
  if (!system.Factorize()) return std::nullopt;
  return system.Solve(right_hand_side);
}

namespace {

// Empty and a reason when there is no map without flips.
std::optional<PlanePoints> MapByAngles(const ChartMesh& chart, const RestShapes& shapes, bool fill_holes,
                                       VertexBlockSystem& system, const std::function<void()>& poll,
                                       std::string& why) {
  AngleFlattening flattening(chart, shapes, kSmallestAngle, 1, fill_holes);
  std::unique_ptr<VertexBlockSystem> filled;
  if (fill_holes) {
    filled = std::make_unique<VertexBlockSystem>(flattening.VertexCount(), flattening.AllTriangles());
  }
  for (int step = 0; step < kMostSteps; ++step) {
    if (poll) poll();
    if (!flattening.Step(fill_holes ? *filled : system)) {
      why = "the angles of its conformal map can't be computed";
      return std::nullopt;
    }
    if (flattening.LastStep() < kConverged) break;
  }
  if (!(flattening.LastStep() < kGoodEnough)) {
    why = "the angles of its conformal map don't settle";
    return std::nullopt;
  }
  std::optional<PlanePoints> uv = flattening.LayOut(system);
  if (!uv || !HasNoFlip(chart.triangles, *uv)) {
    why = "its conformal map folds";
    return std::nullopt;
  }
  return uv;
}

// Sum of the squared changes of angles between the rest shapes and a map without flips.
double AngleChange(const Triangles& triangles, const RestShapes& shapes, const PlanePoints& uv) {
  double sum = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const RestShape flat =
        ShapeFromCorners(uv[At(triangles(t, 0))], uv[At(triangles(t, 1))], uv[At(triangles(t, 2))]);
    const Corners before = AnglesOf(shapes[At(t)]), after = AnglesOf(flat);
    for (std::size_t i = 0; i < 3; ++i) sum += (after[i] - before[i]) * (after[i] - before[i]);
  }
  return sum;
}

}  // namespace

std::optional<PlanePoints> ConformalMap(const ChartMesh& chart, const RestShapes& shapes,
                                        VertexBlockSystem& system, const std::function<void()>& poll,
                                        std::string& why) {
  std::optional<PlanePoints> map = MapByAngles(chart, shapes, false, system, poll, why);
  if (BoundaryLoops(chart.triangles).size() == 1) return map;
  std::string why_not_filled;
  std::optional<PlanePoints> filled = MapByAngles(chart, shapes, true, system, poll, why_not_filled);
  if (!filled) return map;
  if (!map || AngleChange(chart.triangles, shapes, *filled) < AngleChange(chart.triangles, shapes, *map)) {
    return filled;
  }
  return map;
}

}  // namespace dcharts
