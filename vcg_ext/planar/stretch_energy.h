// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planar/complex_plane.h"
#include "planar/rest_shapes.h"

namespace dcharts {

/// What a map costs in one triangle, as a function of its singular values s1 >= s2 > 0 (rest shape -> UV).
/// Every energy is least where s1 = s2 = 1, and infinite where s2 <= 0.
struct StretchEnergy {
  enum class Kind {
    kSymmetricDirichlet,  ///< (s1^2 + s2^2 + s1^-2 + s2^-2) / 4 - 1
    kSander,              ///< (s1^-2 + s2^-2) / 4 + s1 s2 / 2 - 1: least where the L2 stretch of
                          ///< [SSGH01] is, with the scale left free
    kSanderTail           ///< kSander + 5 / n reference (x / reference)^n where x is TriangleContraction and
                          ///< n the exponent: also lowers the worst stretch; plain kSander in slivers,
                          ///< which would otherwise govern it
  };
  Kind kind = Kind::kSymmetricDirichlet;
  int exponent = 6;      ///< of kSanderTail: the higher, the more it is about the worst triangles; >= 2
  double reference = 1;  ///< of kSanderTail: about the largest contraction in the map, > 0
};

/// The energy of a triangle without its weight, +infinity unless its UV area is positive.
double TriangleEnergy(const StretchEnergy& energy, const RestShape& shape, const Complex& e1,
                      const Complex& e2);

/// kSander without the price of enlarged area (the last terms, where s1 s2 > 1): what stretches the texture
/// on the surface. The triangle must have a positive UV area.
double TriangleContraction(const RestShape& shape, const Complex& e1, const Complex& e2);

/// First and second derivatives of the energy by alpha and beta, weight included. The second ones map
/// (x, y) to (m_alpha x + d_alpha conj(x) + cross_linear y + cross_antilinear conj(y),
///           m_beta y + d_beta conj(y) + conj(cross_linear) x + cross_antilinear conj(x)).
struct TriangleDerivatives {
  Complex gradient_alpha, gradient_beta;
  double m_alpha = 0, m_beta = 0;
  Complex d_alpha, d_beta, cross_linear, cross_antilinear;
};

/// Derivatives with the Hessian made positive semidefinite: the negative ones among its eigenvalues (stretch
/// 2 x 2, twist, flip) are set to zero. The triangle must have a positive UV area.
TriangleDerivatives ProjectedDerivatives(const StretchEnergy& energy, const RestShape& shape,
                                         const Complex& e1, const Complex& e2);

/// The gradient of the symmetric Dirichlet energy with the Hessian of its reweighted local/global proxy
/// (SLIM: Rabinovich et al. 2017), which makes headway from far away. Positive UV area is required.
TriangleDerivatives ReweightedDerivatives(const RestShape& shape, const Complex& e1, const Complex& e2);

}  // namespace dcharts
