// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/vertex_block_system.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <numeric>
#include <utility>

namespace dcharts {
namespace {

constexpr int kEdgeCorners[3][2] = {{0, 1}, {0, 2}, {1, 2}};

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

// The edges of a triangulation as the blocks above the diagonal of a matrix, column by column.
struct UpperPattern {
  std::vector<int> start, row;  // as in BlockMatrix
  std::vector<int> of_edge;     // per triangle its corners 01, 02, 12: where in `row`
};

// `place`: the row and column of each vertex.
UpperPattern PatternOf(const Triangles& triangles, const std::vector<int>& place) {
  const std::size_t count = place.size(), edge_count = At(triangles.rows()) * 3;
  std::vector<int> low(edge_count), high(edge_count);
  std::vector<int> end_of_row(count + 1, 0), end_of_column(count + 1, 0);
  std::size_t e = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const int at[3] = {place[At(triangles(t, 0))], place[At(triangles(t, 1))], place[At(triangles(t, 2))]};
    for (const auto& edge : kEdgeCorners) {
      low[e] = std::min(at[edge[0]], at[edge[1]]);
      high[e] = std::max(at[edge[0]], at[edge[1]]);
      ++end_of_row[At(low[e]) + 1];
      ++end_of_column[At(high[e]) + 1];
      ++e;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    end_of_row[i + 1] += end_of_row[i];
    end_of_column[i + 1] += end_of_column[i];
  }
  std::vector<int> by_row(edge_count);
  for (e = 0; e < edge_count; ++e) by_row[At(end_of_row[At(low[e])]++)] = static_cast<int>(e);
  // In this order, each column is filled from above; an edge of two triangles comes twice.
  const std::vector<int> begin(end_of_column.begin(), end_of_column.end() - 1);
  std::vector<int> filled(edge_count);
  UpperPattern pattern;
  pattern.of_edge.resize(edge_count);
  for (const int k : by_row) {
    const std::size_t column = At(high[At(k)]);
    int& end = end_of_column[column];
    if (end == begin[column] || filled[At(end) - 1] != low[At(k)]) filled[At(end++)] = low[At(k)];
    pattern.of_edge[At(k)] = end - 1 - begin[column];
  }
  pattern.start.assign(1, 0);
  pattern.start.reserve(count + 1);
  for (std::size_t i = 0; i < count; ++i)
    pattern.start.push_back(pattern.start.back() + end_of_column[i] - begin[i]);
  pattern.row.resize(At(pattern.start.back()));
  for (std::size_t i = 0; i < count; ++i)
    std::copy(filled.begin() + begin[i], filled.begin() + end_of_column[i],
              pattern.row.begin() + pattern.start[i]);
  for (e = 0; e < edge_count; ++e) pattern.of_edge[e] += pattern.start[At(high[e])];
  return pattern;
}

// Minimum degree on the vertex graph: the same fill as on the doubled graph at a fraction of its time.
std::vector<int> FillReducingPlaces(int vertex_count, const Triangles& triangles) {
  std::vector<int> place(At(vertex_count));
  std::iota(place.begin(), place.end(), 0);
  const UpperPattern pattern = PatternOf(triangles, place);
  Eigen::SparseMatrix<float> graph(vertex_count, vertex_count);
  graph.reserve(static_cast<Eigen::Index>(pattern.row.size()) + vertex_count);
  for (int v = 0; v < vertex_count; ++v) {
    graph.startVec(v);
    for (int p = pattern.start[At(v)]; p < pattern.start[At(v) + 1]; ++p)
      graph.insertBack(pattern.row[At(p)], v) = 1;
    graph.insertBack(v, v) = 1;  // which the ordering expects to be there
  }
  graph.finalize();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Upper>(), order);
  for (int i = 0; i < vertex_count; ++i) place[At(order.indices()[i])] = i;
  return place;
}

}  // namespace

VertexBlockSystem::VertexBlockSystem(int vertex_count, const Triangles& triangles)
    : vertex_count_(vertex_count),
      triangles_(triangles),
      place_(FillReducingPlaces(vertex_count, triangles)),
      edges_(At(triangles.rows()) * 3) {
  UpperPattern pattern = PatternOf(triangles, place_);
  matrix_.start = std::move(pattern.start);
  matrix_.row = std::move(pattern.row);
  std::size_t e = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (const auto& edge : kEdgeCorners) {
      edges_[e] = {pattern.of_edge[e], place_[At(triangles(t, edge[0]))] > place_[At(triangles(t, edge[1]))]};
      ++e;
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
