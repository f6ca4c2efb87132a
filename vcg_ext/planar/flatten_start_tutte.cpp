// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/flatten_start_tutte.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "planar/boundary_loops.h"

namespace dcharts {
namespace {

constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kShortestArc = 1e-3;  // of the mean boundary edge: edges without length need an arc, too

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

std::vector<double> EdgeLengths(const Points3& positions, const std::vector<int>& loop) {
  std::vector<double> lengths(loop.size());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    lengths[i] = (positions.row(loop[(i + 1) % loop.size()]) - positions.row(loop[i])).norm();
  }
  return lengths;
}

double Sum(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

}  // namespace

std::optional<PlanePoints> StartFromTutte(const ChartMesh& chart) {
  const std::vector<std::vector<int>> loops = BoundaryLoops(chart.triangles);
  std::size_t outer = 0;
  double longest = -1;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const double length = Sum(EdgeLengths(chart.positions, loops[i]));
    if (length > longest) longest = length, outer = i;
  }

  const Eigen::Index vertex_count = chart.positions.rows();
  PlanePoints uv(At(vertex_count), Complex(0, 0));
  std::vector<char> fixed(At(vertex_count), 0);
  std::vector<double> arcs = EdgeLengths(chart.positions, loops[outer]);
  const double shortest = kShortestArc * longest / static_cast<double>(arcs.size());
  for (double& arc : arcs) arc = longest > 0 ? std::max(arc, shortest) : 1.0;
  const double circumference = Sum(arcs);
  double walked = 0;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const int v = loops[outer][i];
    uv[At(v)] = std::polar(1.0, kTwoPi * walked / circumference);
    fixed[At(v)] = 1;
    walked += arcs[i];
  }

  std::vector<int> unknown(At(vertex_count), -1);
  int unknowns = 0;
  for (Eigen::Index v = 0; v < vertex_count; ++v) {
    if (!fixed[At(v)]) unknown[At(v)] = unknowns++;
  }
  if (unknowns == 0) return uv;
  const int helpers = static_cast<int>(loops.size()) - 1;
  const int size = unknowns + helpers;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size), y = x;
  // A spring between two vertices; rows of fixed ones go to the right hand sides of the others.
  const auto spring = [&](int row, int other, const Complex& fixed_at) {
    if (row < 0) return;
    entries.emplace_back(row, row, 1.0);
    if (other >= 0) {
      entries.emplace_back(row, other, -1.0);
    } else {
      x[row] += fixed_at.real();
      y[row] += fixed_at.imag();
    }
  };
  // Inner edges come twice, boundary edges once, which is a positive weight, too.
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = chart.triangles(t, k), b = chart.triangles(t, (k + 1) % 3);
      spring(unknown[At(a)], unknown[At(b)], uv[At(b)]);
      spring(unknown[At(b)], unknown[At(a)], uv[At(a)]);
    }
  }
  int helper = unknowns;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (i == outer) continue;
    for (const int v : loops[i]) {
      spring(unknown[At(v)], helper, {});
      spring(helper, unknown[At(v)], {});
    }
    ++helper;
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  x = solver.solve(x).eval();
  y = solver.solve(y).eval();
  for (Eigen::Index v = 0; v < vertex_count; ++v) {
    if (unknown[At(v)] >= 0) uv[At(v)] = {x[unknown[At(v)]], y[unknown[At(v)]]};
  }
  return uv;
}

}  // namespace dcharts
