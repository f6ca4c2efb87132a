// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/vertex_block_system.h"

#include <Eigen/OrderingMethods>
#include <algorithm>

namespace dcharts {
namespace {

constexpr int kEdgeCorners[3][2] = {{0, 1}, {0, 2}, {1, 2}};

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

// Minimum degree on the vertex graph: the same fill as on the doubled graph at a fraction of its time.
std::vector<int> FillReducingPlaces(int vertex_count, const Triangles& triangles) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(At(triangles.rows()) * 6 + At(vertex_count));
  for (int v = 0; v < vertex_count; ++v) entries.emplace_back(v, v, 1.0);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (const auto& edge : kEdgeCorners) {
      const int a = triangles(t, edge[0]), b = triangles(t, edge[1]);
      entries.emplace_back(a, b, 1.0);
      entries.emplace_back(b, a, 1.0);
    }
  }
  Eigen::SparseMatrix<double> graph(vertex_count, vertex_count);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  std::vector<int> place(At(vertex_count));
  for (int i = 0; i < vertex_count; ++i) place[At(order.indices()[i])] = i;
  return place;
}

}  // namespace

VertexBlockSystem::VertexBlockSystem(int vertex_count, const Triangles& triangles)
    : vertex_count_(vertex_count),
      triangles_(triangles),
      place_(FillReducingPlaces(vertex_count, triangles)),
      diagonal_(At(vertex_count)),
      edges_(At(triangles.rows()) * 3) {
  // The earlier neighbours of every vertex, by place.
  std::vector<std::vector<int>> earlier(At(vertex_count));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (const auto& edge : kEdgeCorners) {
      const int a = place_[At(triangles(t, edge[0]))], b = place_[At(triangles(t, edge[1]))];
      earlier[At(std::max(a, b))].push_back(std::min(a, b));
    }
  }
  std::vector<int> column_start(At(vertex_count));
  int entries = 0;
  for (int v = 0; v < vertex_count; ++v) {
    std::vector<int>& list = earlier[At(v)];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    column_start[At(v)] = entries;
    entries += 4 * static_cast<int>(list.size()) + 3;
  }
  matrix_.resize(2 * vertex_count, 2 * vertex_count);
  matrix_.resizeNonZeros(entries);
  int* outer = matrix_.outerIndexPtr();
  int* inner = matrix_.innerIndexPtr();
  for (int v = 0; v < vertex_count; ++v) {
    const std::vector<int>& list = earlier[At(v)];
    int* at = inner + column_start[At(v)];
    for (int half = 0; half < 2; ++half) {
      outer[2 * v + half] = static_cast<int>(at - inner);
      for (const int row : list) {
        *at++ = 2 * row;
        *at++ = 2 * row + 1;
      }
      *at++ = 2 * v;
      if (half == 1) *at++ = 2 * v + 1;
    }
  }
  outer[2 * vertex_count] = entries;

  for (int v = 0; v < vertex_count; ++v) {
    const int p = place_[At(v)], before = 2 * static_cast<int>(earlier[At(p)].size());
    diagonal_[At(v)] = {outer[2 * p] + before, outer[2 * p + 1] + before, false};
  }
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int e = 0; e < 3; ++e) {
      const int a = place_[At(triangles(t, kEdgeCorners[e][0]))],
                b = place_[At(triangles(t, kEdgeCorners[e][1]))];
      const int row = std::min(a, b), column = std::max(a, b);
      const std::vector<int>& list = earlier[At(column)];
      const int before = 2 * static_cast<int>(std::lower_bound(list.begin(), list.end(), row) - list.begin());
      edges_[At(3 * t + e)] = {outer[2 * column] + before, outer[2 * column + 1] + before, a > b};
    }
  }
  SetZero();
  solver_.analyzePattern(matrix_);
}

void VertexBlockSystem::SetZero() {
  std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
}

void VertexBlockSystem::Add(Eigen::Index triangle, int k, int l, const Block2& block) {
  double* values = matrix_.valuePtr();
  if (k == l) {
    const Slot& slot = diagonal_[At(triangles_(triangle, k))];
    values[slot.first] += block.m00;
    values[slot.second] += block.m01;
    values[slot.second + 1] += block.m11;
    return;
  }
  const Slot& slot = edges_[At(3 * triangle + k + l - 1)];
  values[slot.first] += block.m00;
  values[slot.first + 1] += slot.transposed ? block.m01 : block.m10;
  values[slot.second] += slot.transposed ? block.m10 : block.m01;
  values[slot.second + 1] += block.m11;
}

void VertexBlockSystem::AddDiagonal(Eigen::Index vertex, double value) {
  const Slot& slot = diagonal_[At(vertex)];
  matrix_.valuePtr()[slot.first] += value;
  matrix_.valuePtr()[slot.second + 1] += value;
}

void VertexBlockSystem::Regularize(double factor) {
  const double* values = matrix_.valuePtr();
  double sum = 0;
  for (const Slot& slot : diagonal_) sum += values[slot.first] + values[slot.second + 1];
  const double value = factor * sum / (2.0 * vertex_count_);
  for (int v = 0; v < vertex_count_; ++v) AddDiagonal(v, value);
}

void VertexBlockSystem::Pin(Eigen::Index vertex, const Complex& value, PlanePoints& right_hand_side) {
  const int p = place_[At(vertex)];
  std::vector<double> shift(2 * At(vertex_count_), 0.0);
  const double pinned[2] = {value.real(), value.imag()};
  for (int column = 0; column < matrix_.outerSize(); ++column) {
    for (Matrix::InnerIterator it(matrix_, column); it; ++it) {
      const int row = static_cast<int>(it.row());
      const bool in_row = row / 2 == p, in_column = column / 2 == p;
      if (!in_row && !in_column) continue;
      if (in_row && !in_column) shift[At(column)] += it.value() * pinned[row % 2];
      if (in_column && !in_row) shift[At(row)] += it.value() * pinned[column % 2];
      it.valueRef() = row == column ? 1.0 : 0.0;
    }
  }
  for (int v = 0; v < vertex_count_; ++v) {
    const std::size_t at = 2 * At(place_[At(v)]);
    right_hand_side[At(v)] -= Complex(shift[at], shift[at + 1]);
  }
  right_hand_side[At(vertex)] = value;
}

bool VertexBlockSystem::Factorize() {
  solver_.factorize(matrix_);
  if (solver_.info() != Eigen::Success) return false;
  return solver_.vectorD().minCoeff() > 0;
}

PlanePoints VertexBlockSystem::Solve(const PlanePoints& right_hand_side) const {
  Eigen::VectorXd b(2 * vertex_count_);
  for (int v = 0; v < vertex_count_; ++v) {
    b[2 * place_[At(v)]] = right_hand_side[At(v)].real();
    b[2 * place_[At(v)] + 1] = right_hand_side[At(v)].imag();
  }
  const Eigen::VectorXd x = solver_.solve(b);
  PlanePoints solution(At(vertex_count_));
  for (int v = 0; v < vertex_count_; ++v) {
    solution[At(v)] = {x[2 * place_[At(v)]], x[2 * place_[At(v)] + 1]};
  }
  return solution;
}

}  // namespace dcharts
