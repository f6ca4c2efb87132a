// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/equal_outlines.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include "pattern/build_pieces.h"
#include "pattern/outline.h"
#include "pattern/segments.h"

namespace dcharts {
namespace {

// Whether two segments cross in a point inside both, by more than rounding.
bool PassThrough(const LineSegment& s, const LineSegment& t) {
  constexpr double kRounding = 1e-7;  // mm
  const auto apart = [](const LineSegment& line, const LineSegment& ends) {
    const double least = kRounding * (line.b - line.a).norm();
    const double p = Orient(line.a, line.b, ends.a), q = Orient(line.a, line.b, ends.b);
    return (p > least && q < -least) || (p < -least && q > least);
  };
  return apart(s, t) && apart(t, s);
}

/// The corners of one piece, and its edges with the lengths they are to have.
class OutlineFit {
 public:
  OutlineFit(const Piece& piece, const std::vector<std::vector<double>>& wanted) {
    for (size_t l = 0; l < piece.loops.size(); ++l) {
      const int base = static_cast<int>(start_.size()), size = static_cast<int>(piece.loops[l].size());
      for (int k = 0; k < size; ++k) {
        start_.push_back(piece.loops[l][k].at);
        edges_.push_back({base + k, base + (k + 1) % size, wanted[l][k]});
      }
    }
  }

  void Run(double most_shift, Piece& piece) const {
    std::vector<Point2> at = start_;
    constexpr int kSteps = 12;
    for (int step = 0; step < kSteps; ++step)
      if (!Step(at)) break;
    double shift = 0;
    for (size_t v = 0; v < at.size(); ++v) shift = std::max(shift, (at[v] - start_[v]).norm());
    const bool touches = AnyCross(SegmentsAt(start_));
    double share = shift > most_shift ? most_shift / shift : 1;
    std::vector<Point2> moved = start_;
    for (int attempt = 0; attempt < 4; ++attempt, share /= 2) {
      for (size_t v = 0; v < at.size(); ++v) moved[v] = start_[v] + share * (at[v] - start_[v]);
      if (Area(moved) > 0 && !(touches ? PassesAnew(moved) : AnyCross(SegmentsAt(moved)))) break;
      moved = start_;
    }
    size_t v = 0;
    for (OutlineLoop& loop : piece.loops)
      for (OutlinePoint& point : loop) point.at = moved[v++];
  }

 private:
  struct Edge {
    int a, b;
    double length;
  };

  double Area(const std::vector<Point2>& at) const {
    double twice = 0;
    for (const Edge& e : edges_) twice += at[e.a].x() * at[e.b].y() - at[e.a].y() * at[e.b].x();
    return twice / 2;
  }

  std::vector<LineSegment> SegmentsAt(const std::vector<Point2>& at) const {
    std::vector<LineSegment> segments;
    for (const Edge& e : edges_) segments.push_back({at[e.a], at[e.b], e.a, e.b});
    return segments;
  }

  // An outline may touch itself, where a chart hangs together in a single vertex. Whether edges now pass
  // through each other that did not at the start.
  bool PassesAnew(const std::vector<Point2>& at) const {
    const std::vector<LineSegment> before = SegmentsAt(start_), now = SegmentsAt(at);
    const std::vector<int> meeting = CrossingSegments(now);
    for (int i : meeting)
      for (int j : meeting)
        if (i < j && PassThrough(now[i], now[j]) && !PassThrough(before[i], before[j])) return true;
    return false;
  }

  // Gauss-Newton: lengths count a million times as much as places. False when it is done.
  bool Step(std::vector<Point2>& at) const {
    constexpr double kStiff = 1e6, kDone = 1e-9;
    const int size = 2 * static_cast<int>(at.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd gradient(size);
    for (int v = 0; v < size / 2; ++v) {
      gradient.segment<2>(2 * v) = at[v] - start_[v];
      for (int i : {0, 1}) entries.emplace_back(2 * v + i, 2 * v + i, 1.0);
    }
    for (const Edge& e : edges_) {
      const Point2 along = at[e.b] - at[e.a];
      const double length = along.norm();
      if (!(length > 0)) continue;
      const Point2 d = along / length, pull = kStiff * (length - e.length) * d;
      for (int i : {0, 1}) {
        gradient[2 * e.a + i] -= pull[i];
        gradient[2 * e.b + i] += pull[i];
        for (int j : {0, 1}) {
          const double k = kStiff * d[i] * d[j];
          entries.emplace_back(2 * e.a + i, 2 * e.a + j, k);
          entries.emplace_back(2 * e.b + i, 2 * e.b + j, k);
          entries.emplace_back(2 * e.a + i, 2 * e.b + j, -k);
          entries.emplace_back(2 * e.b + i, 2 * e.a + j, -k);
        }
      }
    }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    if (solver.info() != Eigen::Success) return false;
    const Eigen::VectorXd step = -solver.solve(gradient);
    if (!step.allFinite()) return false;
    for (int v = 0; v < size / 2; ++v) at[v] += step.segment<2>(2 * v);
    return step.lpNorm<Eigen::Infinity>() > kDone;
  }

  std::vector<Point2> start_;
  std::vector<Edge> edges_;
};

// The index in its loop of edge k of a side, counted in the seam's direction.
int EdgeOfSide(const SeamSide& side, int k, size_t loop_size) {
  const int along = side.backwards ? side.edges - 1 - k : k;
  return static_cast<int>((side.first + along) % loop_size);
}

}  // namespace

void EqualizeOutlines(double most_shift, Pattern& pattern) {
  // Per piece, loop and edge: the mean of what the seam's sides have.
  std::vector<std::vector<std::vector<double>>> wanted;
  for (const Piece& piece : pattern.pieces) {
    wanted.emplace_back();
    for (const OutlineLoop& loop : piece.loops) wanted.back().emplace_back(loop.size(), 0);
  }
  for (const Seam& seam : pattern.seams)
    for (int k = 0; k < seam.sides.front().edges; ++k) {
      double mean = 0;
      for (const SeamSide& side : seam.sides) {
        const OutlineLoop& loop = pattern.pieces[side.piece].loops[side.loop];
        const int e = EdgeOfSide(side, k, loop.size());
        mean += (loop[e].at - loop[(e + 1) % loop.size()].at).norm() / static_cast<double>(seam.sides.size());
      }
      for (const SeamSide& side : seam.sides) {
        const size_t size = pattern.pieces[side.piece].loops[side.loop].size();
        wanted[side.piece][side.loop][EdgeOfSide(side, k, size)] = mean;
      }
    }
  for (Piece& piece : pattern.pieces) OutlineFit(piece, wanted[piece.id]).Run(most_shift, piece);
  MeasurePieces(pattern);
}

}  // namespace dcharts
