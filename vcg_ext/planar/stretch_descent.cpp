// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/stretch_descent.h"

#include <cmath>

#include "planar/line_search.h"

namespace dcharts {
namespace {

constexpr double kRegularization = 1e-8;  // of the mean diagonal: translations and turns cost nothing
constexpr int kMaxRegularizations = 4;    // each 1000 times the one before
constexpr double kNothingToGain = 1e-20;  // strains of 1e-10, far below what UVs can hold

// Fills the matrix and returns the gradient.
PlanePoints Assemble(const StretchEnergy& energy, StepKind step, const Triangles& triangles,
                     const RestShapes& shapes, const PlanePoints& uv, VertexBlockSystem& system) {
  PlanePoints gradient(uv.size(), Complex(0, 0));
  system.SetZero();
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const RestShape& shape = shapes[static_cast<std::size_t>(t)];
    std::size_t corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = static_cast<std::size_t>(triangles(t, k));
    const Complex e1 = uv[corner[1]] - uv[corner[0]], e2 = uv[corner[2]] - uv[corner[0]];
    const TriangleDerivatives d = step == StepKind::kReweighted ? ReweightedDerivatives(shape, e1, e2)
                                                                : ProjectedDerivatives(energy, shape, e1, e2);
    // alpha = sum of a_k z_k, beta = sum of conj(a_k) z_k
    const Complex a[3] = {-shape.a1 - shape.a2, shape.a1, shape.a2};
    for (int k = 0; k < 3; ++k) {
      gradient[corner[k]] += ConjMul(a[k], d.gradient_alpha) + Mul(a[k], d.gradient_beta);
      for (int l = k; l < 3; ++l) {
        const Complex product = Mul(a[k], a[l]), turned = ConjMul(a[k], a[l]);
        const Complex linear = d.m_alpha * turned + d.m_beta * std::conj(turned) +
                               Mul(d.cross_linear, std::conj(product)) + ConjMul(d.cross_linear, product);
        const Complex antilinear = Mul(d.d_alpha, std::conj(product)) + Mul(d.d_beta, product) +
                                   2.0 * turned.real() * d.cross_antilinear;
        system.Add(t, k, l, BlockOf(linear, antilinear));
      }
    }
  }
  return gradient;
}

void AddPulls(const VertexPulls& pulls, const PlanePoints& uv, VertexBlockSystem& system,
              PlanePoints& gradient) {
  for (const VertexPull& pull : pulls) {
    const double x = pull.direction.real(), y = pull.direction.imag(), k = pull.stiffness;
    gradient[pull.vertex] += k * pull.Off(uv) * pull.direction;
    system.AddDiagonal(static_cast<Eigen::Index>(pull.vertex),
                       Block2{k * x * x, k * x * y, k * x * y, k * y * y});
  }
}

}  // namespace

double Descend(const StretchEnergy& energy, const DescentOptions& options, const Triangles& triangles,
               const RestShapes& shapes, VertexBlockSystem& system, const std::function<void()>& poll,
               PlanePoints& uv) {
  const auto value_of = [&](const PlanePoints& map) {
    const double of_map = MapEnergy(energy, triangles, shapes, map);
    return options.pulls == nullptr ? of_map : of_map + PullEnergy(*options.pulls, map);
  };
  double value = value_of(uv);
  PlanePoints right_hand_side(uv.size());
  for (int step = 0; step < options.max_steps; ++step) {
    if (poll) poll();
    PlanePoints gradient = Assemble(energy, options.step, triangles, shapes, uv, system);
    if (options.pulls != nullptr) AddPulls(*options.pulls, uv, system, gradient);
    for (std::size_t v = 0; v < uv.size(); ++v) right_hand_side[v] = -gradient[v];
    bool moved = false;
    double slope = 0;
    double regularization = kRegularization;
    for (int attempt = 0; attempt < kMaxRegularizations && !moved; ++attempt, regularization *= 1000) {
      system.Regularize(regularization);
      if (!system.Factorize()) continue;
      const PlanePoints direction = system.Solve(right_hand_side);
      slope = 0;
      for (std::size_t v = 0; v < uv.size(); ++v) slope += Dot(gradient[v], direction[v]);
      if (!(slope < 0) || !std::isfinite(slope)) continue;
      if (-slope <= kNothingToGain || value + slope > options.bound) return value;
      moved = SearchLine(value_of, triangles, direction, slope, options.longest_step, uv, value);
      if (-0.5 * slope <= options.tolerance * value || value <= options.enough) return value;
    }
    if (!moved) return value;
  }
  return value;
}

}  // namespace dcharts
