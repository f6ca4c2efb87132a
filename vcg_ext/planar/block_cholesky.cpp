// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/block_cholesky.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <queue>
#include <utility>

#include "common/parallel.h"

namespace dcharts {
namespace {

using Eigen::Matrix2d;

std::size_t At(int i) { return static_cast<std::size_t>(i); }

// False unless `d` is positive definite.
bool Invert(const Matrix2d& d, Matrix2d& inverse) {
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
  FindParts(count);
  next_alike_.assign(At(size), -1);
  for (int k = 0; k < size; ++k)
    if (const int next = parent_[At(k)]; next >= 0 && count[At(k)] == count[At(next)] + 1)
      next_alike_[At(k)] = next;
  start_.assign(At(size) + 1, 0);
  for (int k = 0; k < size; ++k) start_[At(k) + 1] = start_[At(k)] + count[At(k)];
  row_.resize(At(start_.back()));
  l_.resize(row_.size());
  inverse_d_.resize(At(size));
  // Which blocks of row k of L are there: children before parents.
  columns_.clear();
  columns_.reserve(row_.size());
  for (std::vector<int>& starts : part_start_) {
    starts.clear();
    starts.reserve(At(size) + 1);
  }
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
    for (const int part : {kFirst, kSecond, kTop}) {
      part_start_[part].push_back(static_cast<int>(columns_.size()));
      if (rows_of_[part].empty()) continue;
      if (rows_of_[part].size() == At(size))
        columns_.insert(columns_.end(), order.begin() + first, order.end());
      else
        std::copy_if(order.begin() + first, order.end(), std::back_inserter(columns_),
                     [&](int i) { return part_[At(i)] == part; });
    }
    for (; first < size; ++first) row_[At(end[At(order[At(first)])]++)] = k;
  }
  part_start_[kFirst].push_back(static_cast<int>(columns_.size()));
  block_count_of_top_ = 0;
  for (int k : rows_of_[kTop]) block_count_of_top_ += At(End(kTop, k) - Begin(kTop, k));
}

// `count`: of the blocks below the diagonal, per column.
void BlockCholesky::FindParts(const std::vector<int>& count) {
  const int size = static_cast<int>(count.size());
  constexpr int kManyColumns = 10000;
  part_.assign(At(size), kTop);
  if (size > kManyColumns) FindGroups(count);
  for (std::vector<int>& rows : rows_of_) rows.clear();
  for (int k = 0; k < size; ++k) rows_of_[part_[At(k)]].push_back(k);
}

// The root of the largest subtree joins the top until the rest makes two groups that are about as large.
void BlockCholesky::FindGroups(const std::vector<int>& count) {
  const int size = static_cast<int>(count.size());
  constexpr double kMostShare = 0.55;     // of the work of both groups
  std::vector<double> work(At(size), 0);  // of a subtree
  std::vector<std::vector<int>> children(At(size));
  using Subtree = std::pair<double, int>;
  std::priority_queue<Subtree> subtrees;
  double sum = 0;
  for (int k = 0; k < size; ++k) {
    work[At(k)] += (1.0 + count[At(k)]) * (1.0 + count[At(k)]);
    if (parent_[At(k)] >= 0) {
      work[At(parent_[At(k)])] += work[At(k)];
      children[At(parent_[At(k)])].push_back(k);
    } else {
      subtrees.push({work[At(k)], k});
      sum += work[At(k)];
    }
  }
  while (!subtrees.empty()) {
    const auto [largest, root] = subtrees.top();
    if (largest <= kMostShare * sum) {
      auto rest = subtrees;
      double of_part[kParts] = {0, 0, 0};
      for (; !rest.empty(); rest.pop()) {
        const int part = of_part[kFirst] > of_part[kSecond] ? kSecond : kFirst;
        of_part[part] += rest.top().first;
        part_[At(rest.top().second)] = part;
      }
      if (std::max(of_part[kFirst], of_part[kSecond]) <= kMostShare * sum) break;
    }
    subtrees.pop();
    part_[At(root)] = kTop;
    sum -= largest;
    for (const int child : children[At(root)]) {
      subtrees.push({work[At(child)], child});
      sum += work[At(child)];
    }
  }
  for (int k = size - 1; k >= 0; --k)
    if (part_[At(k)] == kTop && parent_[At(k)] >= 0) part_[At(k)] = part_[At(parent_[At(k)])];
}

bool BlockCholesky::Factorize(const BlockMatrix& matrix) {
  std::vector<int> end(start_.begin(), start_.end() - 1);
  std::vector<Update> updates(rows_of_[kFirst].empty() ? 0 : 2);
  InParallel(static_cast<int>(updates.size()), {}, [&](int g, const std::function<void()>&) {
    updates[At(g)] = FactorizeGroup(matrix, kFirst + g, end);
  });
  return FactorizeTop(matrix, updates, end);
}

// `end`: of what is there of each column.
BlockCholesky::Update BlockCholesky::FactorizeGroup(const BlockMatrix& matrix, int group,
                                                    std::vector<int>& end) {
  Update update;
  update.diagonal.reserve(rows_of_[kTop].size());
  update.blocks.reserve(block_count_of_top_);
  std::vector<Matrix2d> y(matrix.diagonal.size(), Matrix2d::Zero());
  const auto load = [&](int k) {
    for (int p = matrix.start[At(k)]; p < matrix.start[At(k) + 1]; ++p)
      if (part_[At(matrix.row[At(p)])] == group) y[At(matrix.row[At(p)])] = matrix.above[At(p)];
  };
  for (int k : rows_of_[group]) {
    load(k);
    Matrix2d d = matrix.diagonal[At(k)];
    Eliminate(group, k, end, y, d);
    update.is_positive = Invert(d, inverse_d_[At(k)]);
    if (!update.is_positive) return update;
  }
  for (int k : rows_of_[kTop]) {
    load(k);
    Matrix2d d = Matrix2d::Zero();
    Eliminate(group, k, end, y, d);
    update.diagonal.push_back(d);
    for (int c = Begin(kTop, k); c < End(kTop, k); ++c) {
      Matrix2d& block = y[At(columns_[At(c)])];
      update.blocks.push_back(block);
      block.setZero();
    }
  }
  return update;
}

bool BlockCholesky::FactorizeTop(const BlockMatrix& matrix, const std::vector<Update>& updates,
                                 std::vector<int>& end) {
  for (const Update& update : updates)
    if (!update.is_positive) return false;
  std::vector<Matrix2d> y(matrix.diagonal.size(), Matrix2d::Zero());
  std::size_t row = 0, first_block = 0;
  for (int k : rows_of_[kTop]) {
    for (int p = matrix.start[At(k)]; p < matrix.start[At(k) + 1]; ++p)
      if (part_[At(matrix.row[At(p)])] == kTop) y[At(matrix.row[At(p)])] = matrix.above[At(p)];
    Matrix2d d = matrix.diagonal[At(k)];
    for (const Update& update : updates) {
      std::size_t block = first_block;
      for (int c = Begin(kTop, k); c < End(kTop, k); ++c) y[At(columns_[At(c)])] += update.blocks[block++];
      d += update.diagonal[row];
    }
    first_block += At(End(kTop, k) - Begin(kTop, k));
    ++row;
    Eliminate(kTop, k, end, y, d);
    if (!Invert(d, inverse_d_[At(k)])) return false;
  }
  return true;
}

// The columns of a part in a row: their blocks of L from `y`, which is zero there then, and what they add to
// the others and to the row's diagonal `d`. Of two columns that are alike below, both add to each block at
// once.
void BlockCholesky::Eliminate(int part, int row, std::vector<int>& end, std::vector<Matrix2d>& y,
                              Matrix2d& d) {
  // Known to stay where they are, which the compiler can't tell.
  const int *const starts = start_.data(), *const rows = row_.data(), *const columns = columns_.data(),
                   *const next_alike = next_alike_.data();
  int* const ends = end.data();
  Matrix2d *const l = l_.data(), *const blocks = y.data();
  Matrix2d sum = d.transpose();
  const auto take = [&](int i) {
    const Matrix2d x = blocks[i];
    blocks[i].setZero();
    return x;
  };
  const auto divide = [&](int i, int at, const Matrix2d& x) {
    const Matrix2d turned = inverse_d_[At(i)].lazyProduct(x);
    const Matrix2d of_l = turned.transpose();
    l[at] = of_l;
    sum.noalias() -= of_l.lazyProduct(x);
  };
  const int last = End(part, row);
  for (int c = Begin(part, row); c < last; ++c) {
    const int i = columns[c], stop = ends[i]++;
    const Matrix2d x = take(i);
    int p = starts[i];
    if (c + 1 == last || columns[c + 1] != next_alike[i]) {
      for (; p < stop; ++p) blocks[rows[p]].noalias() -= l[p].lazyProduct(x);
      divide(i, stop, x);
      continue;
    }
    const int next = columns[++c], stop_next = ends[next]++;
    blocks[next].noalias() -= l[p++].lazyProduct(x);
    const Matrix2d x_next = take(next);
    for (int q = starts[next]; q < stop_next; ++p, ++q) {
      Matrix2d block = blocks[rows[q]];
      block.noalias() -= l[p].lazyProduct(x);
      block.noalias() -= l[q].lazyProduct(x_next);
      blocks[rows[q]] = block;
    }
    divide(i, stop, x);
    divide(next, stop_next, x_next);
  }
  d = sum.transpose();
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
