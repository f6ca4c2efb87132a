// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/block_cholesky.h"

#include <algorithm>

namespace dcharts {
namespace {

std::size_t At(int i) { return static_cast<std::size_t>(i); }

// False unless `d` is positive definite.
bool Invert(const Eigen::Matrix2d& d, Eigen::Matrix2d& inverse) {
  if (!(d(0, 0) > 0)) return false;
  const double factor = d(0, 1) / d(0, 0), rest = d(1, 1) - factor * d(0, 1);
  if (!(rest > 0)) return false;
  inverse(1, 1) = 1 / rest;
  inverse(0, 1) = inverse(1, 0) = -factor / rest;
  inverse(0, 0) = 1 / d(0, 0) + factor * factor / rest;
  return inverse.allFinite();
}

}  // namespace

void BlockCholesky::Analyze(const BlockMatrix& matrix) {
  const int size = static_cast<int>(matrix.diagonal.size());
  parent_.assign(At(size), -1);
  std::vector<int> count(At(size), 0), seen(At(size), -1);
  for (int k = 0; k < size; ++k) {
    seen[At(k)] = k;
    for (int p = matrix.start[At(k)]; p < matrix.start[At(k) + 1]; ++p) {
      for (int i = matrix.row[At(p)]; seen[At(i)] != k; i = parent_[At(i)]) {
        if (parent_[At(i)] < 0) parent_[At(i)] = k;
        ++count[At(i)];
        seen[At(i)] = k;
      }
    }
  }
  start_.assign(At(size) + 1, 0);
  for (int k = 0; k < size; ++k) start_[At(k) + 1] = start_[At(k)] + count[At(k)];
  row_.resize(At(start_.back()));
  l_.resize(row_.size());
  inverse_d_.resize(At(size));
  // Which blocks of row k of L are there: children before parents.
  columns_.clear();
  columns_.reserve(row_.size());
  row_start_.assign(1, 0);
  std::vector<int> end(start_.begin(), start_.end() - 1), path(At(size)), order(At(size));
  std::fill(seen.begin(), seen.end(), -1);
  for (int k = 0; k < size; ++k) {
    int first = size;
    seen[At(k)] = k;
    for (int p = matrix.start[At(k)]; p < matrix.start[At(k) + 1]; ++p) {
      int length = 0;
      for (int i = matrix.row[At(p)]; seen[At(i)] != k; i = parent_[At(i)]) {
        path[At(length++)] = i;
        seen[At(i)] = k;
      }
      while (length > 0) order[At(--first)] = path[At(--length)];
    }
    columns_.insert(columns_.end(), order.begin() + first, order.end());
    row_start_.push_back(static_cast<int>(columns_.size()));
    for (; first < size; ++first) row_[At(end[At(order[At(first)])]++)] = k;
  }
}

bool BlockCholesky::Factorize(const BlockMatrix& matrix) {
  const int size = static_cast<int>(matrix.diagonal.size());
  std::vector<int> end(start_.begin(), start_.end() - 1);
  std::vector<Eigen::Matrix2d> y(At(size), Eigen::Matrix2d::Zero());
  for (int k = 0; k < size; ++k) {
    for (int p = matrix.start[At(k)]; p < matrix.start[At(k) + 1]; ++p)
      y[At(matrix.row[At(p)])] = matrix.above[At(p)];
    Eigen::Matrix2d d = matrix.diagonal[At(k)];
    for (int c = row_start_[At(k)]; c < row_start_[At(k) + 1]; ++c) {
      const int i = columns_[At(c)];
      const Eigen::Matrix2d x = y[At(i)];
      y[At(i)].setZero();
      const int stop = end[At(i)]++;
      for (int p = start_[At(i)]; p < stop; ++p) y[At(row_[At(p)])].noalias() -= l_[At(p)].lazyProduct(x);
      const Eigen::Matrix2d turned = inverse_d_[At(i)] * x;
      d.noalias() -= x.transpose().lazyProduct(turned);
      l_[At(stop)] = turned.transpose();
    }
    if (!Invert(d, inverse_d_[At(k)])) return false;
  }
  return true;
}

void BlockCholesky::Solve(std::vector<Eigen::Vector2d>& x) const {
  const int size = static_cast<int>(x.size());
  for (int k = 0; k < size; ++k) {
    const Eigen::Vector2d value = x[At(k)];
    for (int p = start_[At(k)]; p < start_[At(k) + 1]; ++p) x[At(row_[At(p)])].noalias() -= l_[At(p)] * value;
  }
  for (int k = size - 1; k >= 0; --k) {
    Eigen::Vector2d value = inverse_d_[At(k)] * x[At(k)];
    for (int p = start_[At(k)]; p < start_[At(k) + 1]; ++p) {
      value.noalias() -= l_[At(p)].transpose() * x[At(row_[At(p)])];
    }
    x[At(k)] = value;
  }
}

}  // namespace dcharts
