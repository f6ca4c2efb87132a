// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/flatten_start.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "planar/flatten_start_angles.h"
#include "planar/flatten_start_tutte.h"
#include "planar/line_search.h"
#include "planar/plane_points.h"

namespace dcharts {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Symmetric Dirichlet energies:
constexpr double kGoodStart = 2;  // a start from angles above it is compared with Tutte's

}  // namespace

double ScaleToBest(const Triangles& triangles, const RestShapes& shapes, PlanePoints& uv) {
  double growing = 0, shrinking = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const RestShape& shape = shapes[static_cast<std::size_t>(t)];
    const Complex z0 = uv[static_cast<std::size_t>(triangles(t, 0))];
    const Complex e1 = uv[static_cast<std::size_t>(triangles(t, 1))] - z0;
    const Complex e2 = uv[static_cast<std::size_t>(triangles(t, 2))] - z0;
    const double determinant = Cross(e1, e2) / shape.twice_area;
    if (!(determinant > 0)) return kInfinity;
    const double squares = 2 * (std::norm(Mul(shape.a1, e1) + Mul(shape.a2, e2)) +
                                std::norm(ConjMul(shape.a1, e1) + ConjMul(shape.a2, e2)));
    growing += shape.weight * squares;
    shrinking += shape.weight * squares / determinant / determinant;
  }
  const double factor = std::sqrt(std::sqrt(shrinking / growing));
  if (!std::isfinite(factor) || !(factor > 0)) return kInfinity;
  for (Complex& z : uv) z *= factor;
  return MapEnergy({StretchEnergy::Kind::kSymmetricDirichlet}, triangles, shapes, uv);
}

bool IsUsableStart(const ChartMesh& chart, const Points2* known) {
  return known != nullptr && known->rows() == chart.positions.rows() && known->allFinite();
}

double FlattenStart(const ChartMesh& chart, const RestShapes& shapes, const Points2* known,
                    VertexBlockSystem& system, const std::function<void()>& poll, PlanePoints& uv) {
  constexpr int kAngleSteps = 1;
  double energy = kInfinity;
  if (IsUsableStart(chart, known)) {
    uv = ToPlanePoints(*known);
    energy = ScaleToBest(chart.triangles, shapes, uv);
    if (energy < kGoodKnown) return energy;
    energy = kInfinity;
  }
  if (std::optional<PlanePoints> start = StartFromAngles(chart, shapes, kAngleSteps, system)) {
    uv = std::move(*start);
    energy = ScaleToBest(chart.triangles, shapes, uv);
  }
  if (energy < kGoodStart) return energy;
  if (poll) poll();
  if (std::optional<PlanePoints> start = StartFromTutte(chart)) {
    const double tutte = ScaleToBest(chart.triangles, shapes, *start);
    if (tutte < energy) {
      uv = std::move(*start);
      energy = tutte;
    }
  }
  return energy;
}

}  // namespace dcharts
