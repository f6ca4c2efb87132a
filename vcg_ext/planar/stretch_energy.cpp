// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/stretch_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dcharts {
namespace {

struct LinearMap {
  double p = 0, q = 0;          // |alpha|, |beta|
  Complex alpha_way, beta_way;  // their directions
  double s1 = 0, s2 = 0;
};

// s2 comes from the area and not from p - q, so that its sign is that of the triangle in the plane.
LinearMap MapOf(const RestShape& shape, const Complex& e1, const Complex& e2) {
  LinearMap map;
  const Complex alpha = Mul(shape.a1, e1) + Mul(shape.a2, e2);
  const Complex beta = ConjMul(shape.a1, e1) + ConjMul(shape.a2, e2);
  map.p = std::sqrt(std::norm(alpha));
  map.q = std::sqrt(std::norm(beta));
  map.alpha_way = map.p > 0 ? alpha * (1 / map.p) : Complex(1, 0);
  map.beta_way = map.q > 0 ? beta * (1 / map.q) : Complex(1, 0);
  map.s1 = map.p + map.q;
  map.s2 = Cross(e1, e2) / (shape.twice_area * map.s1);
  return map;
}

double Square(double x) { return x * x; }

double Power(double x, int exponent) {
  double power = 1;
  for (; exponent > 0; exponent /= 2, x *= x) {
    if (exponent % 2 == 1) power *= x;
  }
  return power;
}

// The tail of kSanderTail and its derivatives by x. A power of the energy above its minimum, not of the
// energy itself: so it tells bad from good in nearly isometric charts as well.
constexpr double kTailWeight = 5;

double Tail(const StretchEnergy& energy, double x) {
  return kTailWeight / energy.exponent * energy.reference * Power(x / energy.reference, energy.exponent);
}

double TailFirst(const StretchEnergy& energy, double x) {
  return kTailWeight * Power(x / energy.reference, energy.exponent - 1);
}

double TailSecond(const StretchEnergy& energy, double x) {
  const double slope = kTailWeight * (energy.exponent - 1);
  return slope * Power(x / energy.reference, energy.exponent - 2) / energy.reference;
}

// Both energies as sums of squares: no digits are lost near the isometry.
double SymmetricDirichlet(double s1, double s2) {
  return 0.25 * (Square((s1 - 1) * (s1 + 1) / s1) + Square((s2 - 1) * (s2 + 1) / s2));
}

double Sander(double s1, double s2) {
  const double area = s1 * s2;
  return 0.25 * Square((s1 - s2) / area) + 0.5 * Square(area - 1) / area;
}

// kSander without what it charges for enlarged area: large where something is stretched in the texture's
// eyes.
double Contraction(double s1, double s2) {
  const double area = s1 * s2;
  return 0.25 * Square((s1 - s2) / area) + (area < 1 ? 0.5 * Square(area - 1) / area : 0.0);
}

// Derivatives of an energy by s1 and s2, and flip = (d1 - d2) / (s1 - s2), which has a limit at s1 = s2.
struct ValueDerivatives {
  double d1 = 0, d2 = 0, d11 = 0, d22 = 0, d12 = 0, flip = 0;
};

ValueDerivatives DerivativesOf(const StretchEnergy& energy, bool sliver, double s1, double s2) {
  ValueDerivatives v;
  const double i1 = 1 / s1, i2 = 1 / s2, i1_3 = i1 * i1 * i1, i2_3 = i2 * i2 * i2;
  const double shared = (s1 * s1 + s1 * s2 + s2 * s2) * i1_3 * i2_3;
  if (energy.kind == StretchEnergy::Kind::kSymmetricDirichlet) {
    v.d1 = 0.5 * (s1 - i1_3);
    v.d2 = 0.5 * (s2 - i2_3);
    v.d11 = 0.5 + 1.5 * i1_3 * i1;
    v.d22 = 0.5 + 1.5 * i2_3 * i2;
    v.flip = 0.5 * (1 + shared);
    return v;
  }
  v.d1 = 0.5 * (s2 - i1_3);
  v.d2 = 0.5 * (s1 - i2_3);
  v.d11 = 1.5 * i1_3 * i1;
  v.d22 = 1.5 * i2_3 * i2;
  v.d12 = 0.5;
  v.flip = 0.5 * (shared - 1);
  if (energy.kind == StretchEnergy::Kind::kSander || sliver) return v;
  ValueDerivatives x = v;  // of Contraction
  const double area = s1 * s2;
  if (area > 1) {
    const double price = 0.5 * (1 - 1 / (area * area)), price2 = 1 / (area * area * area);
    x.d1 -= price * s2;
    x.d2 -= price * s1;
    x.d11 -= price2 * s2 * s2;
    x.d22 -= price2 * s1 * s1;
    x.d12 -= price2 * area + price;
    x.flip += price;
  }
  const double value = Contraction(s1, s2);
  const double first = TailFirst(energy, value), second = TailSecond(energy, value);
  ValueDerivatives w;
  w.d1 = v.d1 + first * x.d1;
  w.d2 = v.d2 + first * x.d2;
  w.d11 = v.d11 + first * x.d11 + second * x.d1 * x.d1;
  w.d22 = v.d22 + first * x.d22 + second * x.d2 * x.d2;
  w.d12 = v.d12 + first * x.d12 + second * x.d1 * x.d2;
  w.flip = v.flip + first * x.flip;
  return w;
}

// Sets the negative eigenvalues of ((a, b), (b, c)) to zero.
void ClampNegative(double& a, double& b, double& c) {
  if (a >= 0 && c >= 0 && a * c >= b * b) return;
  const double middle = 0.5 * (a + c), radius = std::hypot(0.5 * (a - c), b);
  if (middle - radius >= 0) return;
  const double large = middle + radius;
  if (large <= 0) {
    a = b = c = 0;
    return;
  }
  // large times the projector on its eigenvector, (M - small) / (large - small)
  const double scale = large / (2 * radius), small = middle - radius;
  a = scale * (a - small);
  b = scale * b;
  c = scale * (c - small);
}

}  // namespace

double TriangleContraction(const RestShape& shape, const Complex& e1, const Complex& e2) {
  const LinearMap map = MapOf(shape, e1, e2);
  return Contraction(map.s1, map.s2);
}

double TriangleEnergy(const StretchEnergy& energy, const RestShape& shape, const Complex& e1,
                      const Complex& e2) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double twice_area = Cross(e1, e2);
  if (!(twice_area > 0)) return infinity;
  const Complex alpha = Mul(shape.a1, e1) + Mul(shape.a2, e2);
  const Complex beta = ConjMul(shape.a1, e1) + ConjMul(shape.a2, e2);
  const double s1 = std::sqrt(std::norm(alpha)) + std::sqrt(std::norm(beta));
  const double s2 = twice_area / (shape.twice_area * s1);
  double value = 0;
  if (energy.kind == StretchEnergy::Kind::kSymmetricDirichlet) {
    value = SymmetricDirichlet(s1, s2);
  } else {
    value = Sander(s1, s2);
    if (energy.kind == StretchEnergy::Kind::kSanderTail && !shape.sliver) {
      value += Tail(energy, Contraction(s1, s2));
    }
  }
  return std::isfinite(value) ? value : infinity;
}

TriangleDerivatives ProjectedDerivatives(const StretchEnergy& energy, const RestShape& shape,
                                         const Complex& e1, const Complex& e2) {
  const LinearMap map = MapOf(shape, e1, e2);
  const ValueDerivatives v = DerivativesOf(energy, shape.sliver, map.s1, map.s2);
  const double w = shape.weight;
  // The energy as a function of p = |alpha| and q = |beta|, where s1 = p + q and s2 = p - q.
  double pp = v.d11 + 2 * v.d12 + v.d22, pq = v.d11 - v.d22, qq = v.d11 - 2 * v.d12 + v.d22;
  ClampNegative(pp, pq, qq);
  const double twist = std::max(0.0, 2 * (v.d1 + v.d2) / (map.s1 + map.s2));
  const double flip = std::max(0.0, 2 * v.flip);
  const Complex a = map.alpha_way, b = map.beta_way;
  TriangleDerivatives d;
  d.gradient_alpha = w * (v.d1 + v.d2) * a;
  d.gradient_beta = 2 * w * v.flip * map.q * b;
  d.m_alpha = 0.5 * w * (pp + twist);
  d.m_beta = 0.5 * w * (qq + flip);
  d.d_alpha = 0.5 * w * (pp - twist) * Mul(a, a);
  d.d_beta = 0.5 * w * (qq - flip) * Mul(b, b);
  d.cross_linear = 0.5 * w * pq * ConjMul(b, a);
  d.cross_antilinear = 0.5 * w * pq * Mul(a, b);
  return d;
}

TriangleDerivatives ReweightedDerivatives(const RestShape& shape, const Complex& e1, const Complex& e2) {
  const LinearMap map = MapOf(shape, e1, e2);
  const ValueDerivatives v = DerivativesOf(StretchEnergy{}, false, map.s1, map.s2);
  const double w = shape.weight;
  // d(psi)/ds / (s - 1) of each singular value
  const auto reweight = [](double s) { return 0.5 * (s + 1) * (s * s + 1) / (s * s * s); };
  const double w1 = reweight(map.s1), w2 = reweight(map.s2);
  TriangleDerivatives d;
  d.gradient_alpha = w * (v.d1 + v.d2) * map.alpha_way;
  d.gradient_beta = 2 * w * v.flip * map.q * map.beta_way;
  d.m_alpha = d.m_beta = w * (w1 + w2);
  d.cross_antilinear = w * (w1 - w2) * Mul(map.alpha_way, map.beta_way);
  return d;
}

}  // namespace dcharts
