// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
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
/// blocks for numbers: that loads an index for eight products instead of one each]. Of a large matrix two
/// groups of subtrees of the elimination tree are factorized side by side, and what is above them, the top,
/// after them.
class BlockCholesky {
 public:
  /// Takes the pattern of `matrix`; its values don't matter yet.
  void Analyze(const BlockMatrix& matrix);

  /// False when the matrix is not positive definite. The pattern must be the one analyzed.
  bool Factorize(const BlockMatrix& matrix);

  /// Replaces the right hand side by the solution.
  void Solve(std::vector<Eigen::Vector2d>& x) const;

 private:
  static constexpr int kTop = 0, kFirst = 1, kSecond = 2, kParts = 3;

  // What a group adds to the rows of the top.
  struct Update {
    std::vector<Eigen::Matrix2d> blocks{};    // in the columns of the top, row by row
    std::vector<Eigen::Matrix2d> diagonal{};  // per row
    bool is_positive = true;                  // as far as the group is concerned
  };

  // The columns of a part in a row of L.
  int Begin(int part, int row) const { return part_start_[part][static_cast<std::size_t>(row)]; }
  int End(int part, int row) const {
    if (part == kFirst) return Begin(kSecond, row);
    return part == kSecond ? Begin(kTop, row) : Begin(kFirst, row + 1);
  }

  void FindParts(const std::vector<int>& count);
  void FindGroups(const std::vector<int>& count);
  Update FactorizeGroup(const BlockMatrix& matrix, int group, std::vector<int>& end);
  bool FactorizeTop(const BlockMatrix& matrix, const std::vector<Update>& updates, std::vector<int>& end);
  void Eliminate(int part, int row, std::vector<int>& end, std::vector<Eigen::Matrix2d>& y,
                 Eigen::Matrix2d& d);

  std::vector<int> parent_;              // elimination tree, -1 at roots
  std::vector<int> next_alike_;          // the parent of a column that has blocks in the same rows below it
  std::vector<int> part_;                // per column: in a group, or in the top
  std::vector<int> rows_of_[kParts];     // ascending
  std::vector<int> part_start_[kParts];  // of each row of L in columns_, part by part; kFirst's: and the end
  std::size_t block_count_of_top_ = 0;   // in its own rows and columns
  std::vector<int> start_;               // of each column of L, and the end
  std::vector<int> row_;                 // of each block of L below the diagonal
  std::vector<int> columns_;             // of the blocks in a row, in the order they are found in
  std::vector<Eigen::Matrix2d> l_;       // those blocks
  std::vector<Eigen::Matrix2d> inverse_d_;
};

}  // namespace dcharts
