// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/stretch_descent.h"

#include <cmath>

#include "planar/line_search.h"

namespace dcharts {
namespace {

constexpr double kRegularization = 1e-8;  // of the mean diagonal: translations and turns cost nothing
constexpr int kMaxRegularizations = 4;    // each 1000 times the one before
constexpr double kNothingToGain = 1e-20;  // strains of 1e-10, far below what UVs can hold

// The second derivatives by two corners, of the products of whose coefficients only these count.
Block2 SecondDerivatives(const TriangleDerivatives& d, const Complex& product, const Complex& turned) {
  const Complex linear((d.m_alpha + d.m_beta) * turned.real() + 2 * Dot(d.cross_linear, product),
                       (d.m_alpha - d.m_beta) * turned.imag());
  const Complex sum = d.d_alpha + d.d_beta, difference = d.d_beta - d.d_alpha;
  const Complex antilinear(sum.real() * product.real() - difference.imag() * product.imag() +
                               2 * turned.real() * d.cross_antilinear.real(),
                           sum.imag() * product.real() + difference.real() * product.imag() +
                               2 * turned.real() * d.cross_antilinear.imag());
  return BlockOf(linear, antilinear);
}

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
    // alpha = a1 e1 + a2 e2, beta = conj(a1) e1 + conj(a2) e2
    const Complex &a1 = shape.a1, &a2 = shape.a2;
    const Complex by_e1 = ConjMul(a1, d.gradient_alpha) + Mul(a1, d.gradient_beta);
    const Complex by_e2 = ConjMul(a2, d.gradient_alpha) + Mul(a2, d.gradient_beta);
    gradient[corner[0]] -= by_e1 + by_e2;
    gradient[corner[1]] += by_e1;
    gradient[corner[2]] += by_e2;
    system.AddTriangle(t, SecondDerivatives(d, Mul(a1, a1), ConjMul(a1, a1)),
                       SecondDerivatives(d, Mul(a1, a2), ConjMul(a1, a2)),
                       SecondDerivatives(d, Mul(a2, a2), ConjMul(a2, a2)));
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
