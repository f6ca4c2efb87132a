// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/block_cholesky.h"

#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace dcharts {
namespace {

// Positive definite, with a block above the diagonal wherever `has` says so (row, column).
BlockMatrix Random(int size, const std::function<bool(int, int)>& has) {
  std::minstd_rand random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  BlockMatrix matrix;
  matrix.start.push_back(0);
  for (int column = 0; column < size; ++column) {
    for (int row = 0; row < column; ++row) {
      if (!has(row, column)) continue;
      matrix.row.push_back(row);
      matrix.above.push_back(
          (Eigen::Matrix2d() << number(random), number(random), number(random), number(random)).finished());
    }
    matrix.start.push_back(static_cast<int>(matrix.row.size()));
    const double off = number(random);
    matrix.diagonal.push_back((Eigen::Matrix2d() << 4.0 * size, off, off, 5.0 * size).finished());
  }
  return matrix;
}

Eigen::MatrixXd Dense(const BlockMatrix& matrix) {
  const auto size = static_cast<Eigen::Index>(matrix.diagonal.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(2 * size, 2 * size);
  for (Eigen::Index column = 0; column < size; ++column) {
    const auto c = static_cast<std::size_t>(column);
    dense.block<2, 2>(2 * column, 2 * column) = matrix.diagonal[c];
    for (int p = matrix.start[c]; p < matrix.start[c + 1]; ++p) {
      const Eigen::Index row = matrix.row[static_cast<std::size_t>(p)];
      const Eigen::Matrix2d& block = matrix.above[static_cast<std::size_t>(p)];
      dense.block<2, 2>(2 * row, 2 * column) = block;
      dense.block<2, 2>(2 * column, 2 * row) = block.transpose();
    }
  }
  return dense;
}

TEST(BlockCholesky, SolvesWhatADenseOneDoes) {
  constexpr int kSize = 40, kSide = 8;
  const std::vector<std::function<bool(int, int)>> patterns = {
      [](int, int) { return false; },
      [](int, int) { return true; },                                // all columns alike
      [](int row, int column) { return column == row + 1; },        // a chain
      [](int row, int) { return row == 0; },                        // fills up
      [](int, int column) { return column >= kSize - 3; },          // a few rows that all columns have
      [](int row, int column) { return row / 10 == column / 10; },  // apart from each other
      [](int row, int column) {                                     // a grid
        return column == row + kSide || (column == row + 1 && column % kSide != 0);
      }};
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    const BlockMatrix matrix = Random(kSize, patterns[k]);
    BlockCholesky solver;
    solver.Analyze(matrix);
    ASSERT_TRUE(solver.Factorize(matrix)) << k;
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(2 * kSize, -1, 3);
    std::vector<Eigen::Vector2d> x(kSize);
    for (int v = 0; v < kSize; ++v) x[static_cast<std::size_t>(v)] = right.segment<2>(2 * v);
    solver.Solve(x);
    const Eigen::VectorXd expected = Dense(matrix).llt().solve(right);
    for (int v = 0; v < kSize; ++v)
      EXPECT_LT((x[static_cast<std::size_t>(v)] - expected.segment<2>(2 * v)).norm(), 1e-12) << k << ' ' << v;
  }
}

TEST(BlockCholesky, RefusesWhatIsNotPositiveDefinite) {
  BlockMatrix matrix = Random(12, [](int row, int column) { return column == row + 1; });
  matrix.diagonal[5] *= -1;
  BlockCholesky solver;
  solver.Analyze(matrix);
  EXPECT_FALSE(solver.Factorize(matrix));
}

}  // namespace
}  // namespace dcharts
