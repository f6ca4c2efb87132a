// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/vertex_block_system.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
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
      edges_(At(triangles.rows()) * 3) {
  // The earlier neighbours of every vertex, by place.
  std::vector<std::vector<int>> earlier(At(vertex_count));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (const auto& edge : kEdgeCorners) {
      const int a = place_[At(triangles(t, edge[0]))], b = place_[At(triangles(t, edge[1]))];
      earlier[At(std::max(a, b))].push_back(std::min(a, b));
    }
  }
  matrix_.start.push_back(0);
  for (std::vector<int>& list : earlier) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    matrix_.row.insert(matrix_.row.end(), list.begin(), list.end());
    matrix_.start.push_back(static_cast<int>(matrix_.row.size()));
  }
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int e = 0; e < 3; ++e) {
      const int a = place_[At(triangles(t, kEdgeCorners[e][0]))],
                b = place_[At(triangles(t, kEdgeCorners[e][1]))];
      const int row = std::min(a, b), column = std::max(a, b);
      const std::vector<int>& list = earlier[At(column)];
      const auto found = std::lower_bound(list.begin(), list.end(), row);
      edges_[At(3 * t + e)] = {matrix_.start[At(column)] + static_cast<int>(found - list.begin()), a > b};
    }
  }
  SetZero();
  solver_.Analyze(matrix_);
}

void VertexBlockSystem::SetZero() {
  matrix_.above.assign(matrix_.row.size(), Eigen::Matrix2d::Zero());
  matrix_.diagonal.assign(At(vertex_count_), Eigen::Matrix2d::Zero());
}

void VertexBlockSystem::Add(Eigen::Index triangle, int k, int l, const Block2& block) {
  double* to = nullptr;
  bool transposed = false;
  if (k == l) {
    to = matrix_.diagonal[At(place_[At(triangles_(triangle, k))])].data();
  } else {
    const Slot& slot = edges_[At(3 * triangle + k + l - 1)];
    to = matrix_.above[At(slot.at)].data();
    transposed = slot.transposed;
  }
  to[0] += block.m00;  // column by column
  to[1] += transposed ? block.m01 : block.m10;
  to[2] += transposed ? block.m10 : block.m01;
  to[3] += block.m11;
}

void VertexBlockSystem::AddDiagonal(Eigen::Index vertex, double value) {
  matrix_.diagonal[At(place_[At(vertex)])].diagonal().array() += value;
}

void VertexBlockSystem::AddDiagonal(Eigen::Index vertex, const Block2& block) {
  Eigen::Matrix2d& to = matrix_.diagonal[At(place_[At(vertex)])];
  to(0, 0) += block.m00;
  to(1, 0) += block.m10;
  to(0, 1) += block.m01;
  to(1, 1) += block.m11;
}

void VertexBlockSystem::Regularize(double factor) {
  double sum = 0;
  for (const int place : place_) sum += matrix_.diagonal[At(place)].trace();
  const double value = factor * sum / (2.0 * vertex_count_);
  for (int v = 0; v < vertex_count_; ++v) AddDiagonal(v, value);
}

void VertexBlockSystem::Pin(Eigen::Index vertex, const Complex& value, PlanePoints& right_hand_side) {
  const int pinned = place_[At(vertex)];
  const Eigen::Vector2d pinned_at(value.real(), value.imag());
  std::vector<Eigen::Vector2d> shift(At(vertex_count_), Eigen::Vector2d::Zero());
  for (int column = 0; column < vertex_count_; ++column) {
    for (int p = matrix_.start[At(column)]; p < matrix_.start[At(column) + 1]; ++p) {
      const int row = matrix_.row[At(p)];
      if (row != pinned && column != pinned) continue;
      Eigen::Matrix2d& block = matrix_.above[At(p)];
      if (row == pinned) shift[At(column)] += block.transpose() * pinned_at;
      if (column == pinned) shift[At(row)] += block * pinned_at;
      block.setZero();
    }
  }
  matrix_.diagonal[At(pinned)].setIdentity();
  for (int v = 0; v < vertex_count_; ++v) {
    const Eigen::Vector2d& moved = shift[At(place_[At(v)])];
    right_hand_side[At(v)] -= Complex(moved.x(), moved.y());
  }
  right_hand_side[At(vertex)] = value;
}

bool VertexBlockSystem::Factorize() { return solver_.Factorize(matrix_); }

PlanePoints VertexBlockSystem::Solve(const PlanePoints& right_hand_side) const {
  std::vector<Eigen::Vector2d> x(At(vertex_count_));
  for (int v = 0; v < vertex_count_; ++v) {
    x[At(place_[At(v)])] = {right_hand_side[At(v)].real(), right_hand_side[At(v)].imag()};
  }
  solver_.Solve(x);
  PlanePoints solution(At(vertex_count_));
  for (int v = 0; v < vertex_count_; ++v)
    solution[At(v)] = {x[At(place_[At(v)])].x(), x[At(place_[At(v)])].y()};
  return solution;
}

}  // namespace dcharts
