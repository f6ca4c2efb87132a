// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "planar/block_cholesky.h"
#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"

namespace dcharts {

/// A 2 x 2 block of a matrix that acts on one plane vector per vertex.
struct Block2 {
  double m00 = 0, m01 = 0, m10 = 0, m11 = 0;
};

/// The block that maps x to linear x + antilinear conj(x).
inline Block2 BlockOf(const Complex& linear, const Complex& antilinear) {
  return {linear.real() + antilinear.real(), antilinear.imag() - linear.imag(),
          antilinear.imag() + linear.imag(), linear.real() - antilinear.real()};
}

/// Symmetric positive definite systems with one 2 x 2 block per vertex and per edge of a triangulation. Every
/// linear solve of the flattening has this one pattern, so ordering and symbolic analysis are done once.
class VertexBlockSystem {
 public:
  /// `triangles` must use every vertex and no vertex twice in a triangle.
  VertexBlockSystem(int vertex_count, const Triangles& triangles)
      : VertexBlockSystem(vertex_count, vertex_count, triangles) {}
  /// Only the first `free_count` vertices (> 0) are unknowns. The others' blocks and right hand sides count
  /// nowhere, and they are zero in solutions.
  VertexBlockSystem(int vertex_count, int free_count, const Triangles& triangles);

  void SetZero();

  /// Adds the block in row `k` and column `l` (corners of the triangle, k <= l), and for k < l its transpose
  /// in row `l` and column `k`. Diagonal blocks must be symmetric.
  void Add(Eigen::Index triangle, int k, int l, const Block2& block);

  /// Adds what hangs on the edges e1 = z1 - z0 and e2 = z2 - z0 of a triangle alone: `b11`, `b12`, `b22` act
  /// on e1 and e2.
  void AddTriangle(Eigen::Index triangle, const Block2& b11, const Block2& b12, const Block2& b22);

  /// Adds to the diagonal of one vertex.
  void AddDiagonal(Eigen::Index vertex, double value);
  void AddDiagonal(Eigen::Index vertex, const Block2& block);

  /// Adds `factor` times the mean of the diagonal to all of the diagonal.
  void Regularize(double factor);

  /// Makes the solution at `vertex`, a free one, be `value`, and moves what that contributes to the others to
  /// their right hand sides.
  void Pin(Eigen::Index vertex, const Complex& value, PlanePoints& right_hand_side);

  /// False when the matrix is not positive definite.
  bool Factorize();

  /// The solution of the last factorized matrix.
  PlanePoints Solve(const PlanePoints& right_hand_side) const;

 private:
  /// Where the block of an edge is.
  struct Slot {
    int at = 0;  // -1: nowhere, an end isn't free
    bool transposed = false;
  };

  void AddTo(const Slot& slot, const Block2& block);

  int vertex_count_, free_count_;
  const Triangles& triangles_;
  std::vector<int> place_;   // position of a vertex in the fill-reducing order; beyond it when it isn't free
  std::vector<Slot> edges_;  // per triangle: corners 01, 02, 12
  BlockMatrix matrix_;       // in the fill-reducing order
  BlockCholesky solver_;
};

}  // namespace dcharts
