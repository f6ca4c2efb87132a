// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/vertex_block_system.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <tuple>
#include <utility>

namespace dcharts {
namespace {

constexpr int kEdgeCorners[3][2] = {{0, 1}, {0, 2}, {1, 2}};

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

// The edges of a triangulation, each once.
struct Edges {
  std::vector<int> ends[2];  // the lower vertex, the higher
  std::vector<int>
      of_triangle;  // per triangle its corners 01, 02, 12: which edge; -1 where an end isn't free
};

// Sorted by the higher vertex, then by the lower. `free_count`: vertices below it are free.
Edges EdgesOf(int free_count, const Triangles& triangles) {
  // An edge with an end that isn't free is put into a column beyond the last.
  const std::size_t count = At(free_count), slot_count = At(triangles.rows()) * 3;
  std::vector<int> low(slot_count), high(slot_count);
  std::vector<int> end_of_row(count + 2, 0), end_of_column(count + 2, 0);
  std::size_t e = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (const auto& edge : kEdgeCorners) {
      const auto [least, largest] = std::minmax(triangles(t, edge[0]), triangles(t, edge[1]));
      low[e] = std::min(least, free_count);
      high[e] = std::min(largest, free_count);
      ++end_of_row[At(low[e]) + 1];
      ++end_of_column[At(high[e]) + 1];
      ++e;
    }
  }
  for (std::size_t i = 0; i <= count; ++i) {
    end_of_row[i + 1] += end_of_row[i];
    end_of_column[i + 1] += end_of_column[i];
  }
  std::vector<int> by_row(slot_count);
  for (e = 0; e < slot_count; ++e) by_row[At(end_of_row[At(low[e])]++)] = static_cast<int>(e);
  // In this order, each column is filled from above; an edge of two triangles comes twice.
  const std::vector<int> begin(end_of_column.begin(), end_of_column.end() - 1);
  std::vector<int> filled(slot_count);
  Edges edges;
  edges.of_triangle.resize(slot_count);
  for (const int k : by_row) {
    const std::size_t column = At(high[At(k)]);
    int& end = end_of_column[column];
    if (end == begin[column] || filled[At(end) - 1] != low[At(k)]) filled[At(end++)] = low[At(k)];
    edges.of_triangle[At(k)] = end - 1 - begin[column];
  }
  std::vector<int> first(count);  // of each column
  for (std::size_t i = 0; i < count; ++i) {
    first[i] = static_cast<int>(edges.ends[0].size());
    edges.ends[0].insert(edges.ends[0].end(), filled.begin() + begin[i], filled.begin() + end_of_column[i]);
    edges.ends[1].resize(edges.ends[0].size(), static_cast<int>(i));
  }
  for (e = 0; e < slot_count; ++e) {
    int& edge = edges.of_triangle[e];
    edge = high[e] < free_count ? edge + first[At(high[e])] : -1;
  }
  return edges;
}

// Puts the edges into the columns of a matrix with the vertices in another order; returns the place in it of
// each. `place`: the row and column of each vertex.
std::vector<int> PlaceEdges(const Edges& edges, const std::vector<int>& place, BlockMatrix& matrix,
                            std::size_t size) {
  const std::size_t count = edges.ends[0].size();
  std::vector<int> row(count), column(count), end_of_row(size + 1, 0), by_row(count), at(count);
  matrix.start.assign(size + 1, 0);
  for (std::size_t e = 0; e < count; ++e) {
    std::tie(row[e], column[e]) = std::minmax(place[At(edges.ends[0][e])], place[At(edges.ends[1][e])]);
    ++end_of_row[At(row[e]) + 1];
    ++matrix.start[At(column[e]) + 1];
  }
  for (std::size_t i = 0; i < size; ++i) {
    end_of_row[i + 1] += end_of_row[i];
    matrix.start[i + 1] += matrix.start[i];
  }
  for (std::size_t e = 0; e < count; ++e) by_row[At(end_of_row[At(row[e])]++)] = static_cast<int>(e);
  std::vector<int> end_of_column(matrix.start.begin(), matrix.start.end() - 1);
  matrix.row.resize(count);
  for (const int e : by_row) {
    at[At(e)] = end_of_column[At(column[At(e)])]++;
    matrix.row[At(at[At(e)])] = row[At(e)];
  }
  return at;
}

// Minimum degree on the vertex graph: the same fill as on the doubled graph at a fraction of its time.
std::vector<int> FillReducingPlaces(int vertex_count, int free_count, const Edges& edges) {
  Eigen::SparseMatrix<float> graph(free_count, free_count);
  graph.reserve(static_cast<Eigen::Index>(edges.ends[0].size()) + free_count);
  std::size_t e = 0;
  for (int v = 0; v < free_count; ++v) {
    graph.startVec(v);
    for (; e < edges.ends[0].size() && edges.ends[1][e] == v; ++e) graph.insertBack(edges.ends[0][e], v) = 1;
    graph.insertBack(v, v) = 1;  // which the ordering expects to be there
  }
  graph.finalize();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Upper>(), order);
  std::vector<int> place(At(vertex_count), free_count);
  for (int i = 0; i < free_count; ++i) place[At(order.indices()[i])] = i;
  return place;
}

}  // namespace

VertexBlockSystem::VertexBlockSystem(int vertex_count, int free_count, const Triangles& triangles)
    : vertex_count_(vertex_count),
      free_count_(free_count),
      triangles_(triangles),
      edges_(At(triangles.rows()) * 3) {
  const Edges edges = EdgesOf(free_count, triangles);
  place_ = FillReducingPlaces(vertex_count, free_count, edges);
  const std::vector<int> at = PlaceEdges(edges, place_, matrix_, At(free_count));
  std::size_t e = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (const auto& edge : kEdgeCorners) {
      const int k = edges.of_triangle[e];
      edges_[e] = {k < 0 ? -1 : at[At(k)],
                   place_[At(triangles(t, edge[0]))] > place_[At(triangles(t, edge[1]))]};
      ++e;
    }
  SetZero();
  solver_.Analyze(matrix_);
}

void VertexBlockSystem::SetZero() {
  matrix_.above.assign(matrix_.row.size(), Eigen::Matrix2d::Zero());
  matrix_.diagonal.assign(At(free_count_), Eigen::Matrix2d::Zero());
}

void VertexBlockSystem::AddTo(const Slot& slot, const Block2& block) {
  if (slot.at < 0) return;
  double* const to = matrix_.above[At(slot.at)].data();  // column by column
  to[0] += block.m00;
  to[1] += slot.transposed ? block.m01 : block.m10;
  to[2] += slot.transposed ? block.m10 : block.m01;
  to[3] += block.m11;
}

void VertexBlockSystem::Add(Eigen::Index triangle, int k, int l, const Block2& block) {
  if (k == l)
    AddDiagonal(triangles_(triangle, k), block);
  else
    AddTo(edges_[At(3 * triangle + k + l - 1)], block);
}

void VertexBlockSystem::AddTriangle(Eigen::Index triangle, const Block2& b11, const Block2& b12,
                                    const Block2& b22) {
  // Rows of corners 0, and columns, are less those of 1 and 2 together.
  const Block2 b01{-(b11.m00 + b12.m00), -(b11.m01 + b12.m10), -(b11.m10 + b12.m01), -(b11.m11 + b12.m11)};
  const Block2 b02{-(b12.m00 + b22.m00), -(b12.m01 + b22.m01), -(b12.m10 + b22.m10), -(b12.m11 + b22.m11)};
  AddDiagonal(triangles_(triangle, 0),
              Block2{-(b01.m00 + b02.m00), -(b01.m01 + b02.m01), -(b01.m10 + b02.m10), -(b01.m11 + b02.m11)});
  AddDiagonal(triangles_(triangle, 1), b11);
  AddDiagonal(triangles_(triangle, 2), b22);
  const Slot* const slots = &edges_[At(3 * triangle)];
  AddTo(slots[0], b01);
  AddTo(slots[1], b02);
  AddTo(slots[2], b12);
}

void VertexBlockSystem::AddDiagonal(Eigen::Index vertex, double value) {
  if (vertex < free_count_) matrix_.diagonal[At(place_[At(vertex)])].diagonal().array() += value;
}

void VertexBlockSystem::AddDiagonal(Eigen::Index vertex, const Block2& block) {
  if (vertex >= free_count_) return;
  Eigen::Matrix2d& to = matrix_.diagonal[At(place_[At(vertex)])];
  to(0, 0) += block.m00;
  to(1, 0) += block.m10;
  to(0, 1) += block.m01;
  to(1, 1) += block.m11;
}

void VertexBlockSystem::Regularize(double factor) {
  double sum = 0;
  for (int v = 0; v < free_count_; ++v) sum += matrix_.diagonal[At(place_[At(v)])].trace();
  const double value = factor * sum / (2.0 * free_count_);
  for (int v = 0; v < free_count_; ++v) AddDiagonal(v, value);
}

void VertexBlockSystem::Pin(Eigen::Index vertex, const Complex& value, PlanePoints& right_hand_side) {
  const int pinned = place_[At(vertex)];
  const Eigen::Vector2d pinned_at(value.real(), value.imag());
  std::vector<Eigen::Vector2d> shift(At(free_count_), Eigen::Vector2d::Zero());
  for (int column = 0; column < free_count_; ++column) {
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
  for (int v = 0; v < free_count_; ++v) {
    const Eigen::Vector2d& moved = shift[At(place_[At(v)])];
    right_hand_side[At(v)] -= Complex(moved.x(), moved.y());
  }
  right_hand_side[At(vertex)] = value;
}

bool VertexBlockSystem::Factorize() { return solver_.Factorize(matrix_); }

PlanePoints VertexBlockSystem::Solve(const PlanePoints& right_hand_side) const {
  std::vector<Eigen::Vector2d> x(At(free_count_));
  for (int v = 0; v < free_count_; ++v) {
    x[At(place_[At(v)])] = {right_hand_side[At(v)].real(), right_hand_side[At(v)].imag()};
  }
  solver_.Solve(x);
  PlanePoints solution(At(vertex_count_), Complex(0, 0));
  for (int v = 0; v < free_count_; ++v)
    solution[At(v)] = {x[At(place_[At(v)])].x(), x[At(place_[At(v)])].y()};
  return solution;
}

}  // namespace dcharts
