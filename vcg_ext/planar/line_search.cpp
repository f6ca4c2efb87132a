// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/line_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dcharts {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kShareOfWayToFlip = 0.9;
constexpr double kArmijo = 1e-4;
constexpr int kMaxHalvings = 40;

const Complex& Corner(const PlanePoints& points, const Triangles& triangles, Eigen::Index t, int k) {
  return points[static_cast<std::size_t>(triangles(t, k))];
}

// Smallest positive root of c + b t + a t^2 with c > 0, without cancellation.
double SmallestPositiveRoot(double a, double b, double c) {
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return kInfinity;
  const double root = std::sqrt(discriminant);
  if (b < 0) return 2 * c / (root - b);
  if (a < 0) return (b + root) / (-2 * a);
  return kInfinity;
}

}  // namespace

double MapEnergy(const StretchEnergy& energy, const Triangles& triangles, const RestShapes& shapes,
                 const PlanePoints& uv) {
  double sum = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Complex& z0 = Corner(uv, triangles, t, 0);
    const RestShape& shape = shapes[static_cast<std::size_t>(t)];
    const double value =
        TriangleEnergy(energy, shape, Corner(uv, triangles, t, 1) - z0, Corner(uv, triangles, t, 2) - z0);
    if (value == kInfinity) return kInfinity;
    sum += shape.weight * value;
  }
  return std::isfinite(sum) ? sum : kInfinity;
}

double FirstFlip(const Triangles& triangles, const PlanePoints& uv, const PlanePoints& direction,
                 double up_to) {
  double first = up_to;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Complex& z0 = Corner(uv, triangles, t, 0);
    const Complex& d0 = Corner(direction, triangles, t, 0);
    const Complex e1 = Corner(uv, triangles, t, 1) - z0, e2 = Corner(uv, triangles, t, 2) - z0;
    const Complex f1 = Corner(direction, triangles, t, 1) - d0, f2 = Corner(direction, triangles, t, 2) - d0;
    const double a = Cross(f1, f2), b = Cross(e1, f2) + Cross(f1, e2), c = Cross(e1, e2);
    // Most triangles are far from it.
    if (c + (std::min(b, 0.0) + std::min(a, 0.0) * first) * first > 0) continue;
    first = std::min(first, SmallestPositiveRoot(a, b, c));
  }
  return first < up_to ? first : kInfinity;
}

bool SearchLine(const std::function<double(const PlanePoints&)>& value_of, const Triangles& triangles,
                const PlanePoints& direction, double slope, double longest_step, PlanePoints& uv,
                double& value) {
  double step = std::min(longest_step, kShareOfWayToFlip * FirstFlip(triangles, uv, direction,
                                                                     longest_step / kShareOfWayToFlip));
  PlanePoints trial(uv.size()), best;
  double best_value = value;
  for (int halving = 0; halving < kMaxHalvings; ++halving, step *= 0.5) {
    for (std::size_t v = 0; v < uv.size(); ++v) trial[v] = uv[v] + step * direction[v];
    const double trial_value = value_of(trial);
    if (trial_value < best_value && trial_value <= value + kArmijo * step * slope) {
      best.swap(trial);
      trial.resize(uv.size());
      best_value = trial_value;
      if (step <= 1) break;
    } else if (!best.empty()) {
      break;
    }
  }
  if (best.empty()) return false;
  uv.swap(best);
  value = best_value;
  return true;
}

}  // namespace dcharts
