// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace dcharts {

/// A symmetric matrix of 2 x 2 blocks: the diagonal ones, and those above it, column by column.
struct BlockMatrix {
  std::vector<int> start;  ///< per column, and the end: its first one in `row`
  std::vector<int> row;    ///< of each block above the diagonal, < its column, increasing in a column
  std::vector<Eigen::Matrix2d> above, diagonal;
};

/// L D L^T of symmetric positive definite block matrices with one pattern [Davis, "Algorithm 849", 2005, with
/// blocks for numbers: that loads an index for eight products instead of one each].
class BlockCholesky {
 public:
  /// Takes the pattern of `matrix`; its values don't matter yet.
  void Analyze(const BlockMatrix& matrix);

  /// False when the matrix is not positive definite. The pattern must be the one analyzed.
  bool Factorize(const BlockMatrix& matrix);

  /// Replaces the right hand side by the solution.
  void Solve(std::vector<Eigen::Vector2d>& x) const;

 private:
  std::vector<int> parent_;         // elimination tree, -1 at roots
  std::vector<int> start_;          // of each column of L, and the end
  std::vector<int> row_;            // of each block of L below the diagonal
  std::vector<int> row_start_;      // of each row of L in columns_, and the end
  std::vector<int> columns_;        // of the blocks in a row, in the order they are found in
  std::vector<Eigen::Matrix2d> l_;  // those blocks
  std::vector<Eigen::Matrix2d> inverse_d_;
};

}  // namespace dcharts
