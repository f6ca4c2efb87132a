// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/congruence.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "pattern/outline.h"
#include "pattern/segments.h"

namespace dcharts {
namespace {

using Complex = std::complex<double>;

// Points at equal steps along a closed loop.
std::vector<Complex> Samples(const Polyline& loop, int count) {
  std::vector<double> length{0};
  for (size_t k = 0; k < loop.size(); ++k)
    length.push_back(length.back() + (loop[(k + 1) % loop.size()] - loop[k]).norm());
  std::vector<Complex> samples;
  size_t edge = 0;
  for (int s = 0; s < count; ++s) {
    const double at = length.back() * s / count;
    while (edge + 1 < loop.size() && length[edge + 1] < at) ++edge;
    const double span = length[edge + 1] - length[edge], t = span > 0 ? (at - length[edge]) / span : 0;
    const Point2 p = loop[edge] + t * (loop[(edge + 1) % loop.size()] - loop[edge]);
    samples.emplace_back(p.x(), p.y());
  }
  return samples;
}

/// A piece's outer outline, about the middle of its samples.
struct Shape {
  std::vector<Polyline> loops;
  std::vector<Complex> samples;
  std::vector<double> radii;  // of the samples, sorted
  double area = 0, length = 0, size = 0;
};

constexpr int kSamples = 256;

Shape ShapeOf(const Piece& piece, bool mirrored) {
  Shape shape;
  shape.loops = OutlineOf(piece);
  if (mirrored)
    for (Polyline& loop : shape.loops) {
      for (Point2& p : loop) p.x() = -p.x();
      std::reverse(loop.begin(), loop.end());
    }
  shape.samples = Samples(shape.loops.front(), kSamples);
  Complex middle = 0;
  for (const Complex& z : shape.samples) middle += z / static_cast<double>(kSamples);
  for (Complex& z : shape.samples) z -= middle;
  for (Polyline& loop : shape.loops)
    for (Point2& p : loop) p -= Point2(middle.real(), middle.imag());
  shape.area = piece.area;
  for (const Complex& z : shape.samples) shape.radii.push_back(std::abs(z));
  std::sort(shape.radii.begin(), shape.radii.end());
  shape.size = 2 * shape.radii.back();
  const Polyline& outer = shape.loops.front();
  for (size_t k = 0; k < outer.size(); ++k) shape.length += (outer[(k + 1) % outer.size()] - outer[k]).norm();
  return shape;
}

// How one shape is laid on another: z -> turn z + shift.
struct Pose {
  Complex turn{1, 0}, shift{0, 0};

  Complex operator()(const Complex& z) const { return turn * z + shift; }
  Pose Inverse() const { return {std::conj(turn), -std::conj(turn) * shift}; }
};

Complex NearestOn(const std::vector<Polyline>& loops, const Complex& z) {
  const Point2 p(z.real(), z.imag());
  Point2 nearest = loops.front().front();
  for (const Polyline& loop : loops)
    for (size_t k = 0; k < loop.size(); ++k) {
      const Point2 &a = loop[k], e = loop[(k + 1) % loop.size()] - a;
      const double length = e.squaredNorm();
      const Point2 q = a + (length > 0 ? std::clamp((p - a).dot(e) / length, 0.0, 1.0) : 0) * e;
      if ((p - q).squaredNorm() < (p - nearest).squaredNorm()) nearest = q;
    }
  return {nearest.x(), nearest.y()};
}

// A better pose: each sample is to come to the point of the outline next to it.
Pose Better(const std::vector<Complex>& samples, const Pose& pose, const std::vector<Polyline>& outline) {
  std::vector<Complex> nearest;
  Complex middle = 0, nearest_middle = 0, sum = 0;
  for (const Complex& z : samples) {
    nearest.push_back(NearestOn(outline, pose(z)));
    middle += z / static_cast<double>(samples.size());
    nearest_middle += nearest.back() / static_cast<double>(samples.size());
  }
  for (size_t s = 0; s < samples.size(); ++s)
    sum += (nearest[s] - nearest_middle) * std::conj(samples[s] - middle);
  if (!(std::abs(sum) > 0)) return pose;
  const Complex turn = sum / std::abs(sum);
  return {turn, nearest_middle - turn * middle};
}

// How far the corners of one are from the outline of the other.
double FarthestCorner(const std::vector<Polyline>& from, const Pose& pose, const std::vector<Polyline>& to) {
  double farthest = 0;
  for (const Polyline& loop : from)
    for (const Point2& p : loop) {
      const Complex z = pose(Complex(p.x(), p.y()));
      farthest = std::max(farthest, std::abs(NearestOn(to, z) - z));
    }
  return farthest;
}

// Of shapes of one form, whichever way they are turned, the samples are as far from the middle.
double MeanDifferenceOfRadii(const Shape& a, const Shape& b) {
  double sum = 0;
  for (int s = 0; s < kSamples; ++s) sum += std::abs(a.radii[s] - b.radii[s]);
  return sum / kSamples;
}

// Turns that lay the samples of one on those of the other, within `farthest` on the average, the best first.
// Of all starting points along the loop these are the ones that fit better than those beside them.
std::vector<Complex> LikelyTurns(const Shape& a, const Shape& b, double farthest) {
  double squares = 0;
  for (int s = 0; s < kSamples; ++s) squares += std::norm(a.samples[s]) + std::norm(b.samples[s]);
  std::vector<Complex> sums(kSamples, 0);  // of products: the larger, the better the best turn is, conj(sum)
  for (int shift = 0; shift < kSamples; ++shift)
    for (int s = 0; s < kSamples; ++s)
      sums[shift] += a.samples[(s + shift) % kSamples] * std::conj(b.samples[s]);
  std::vector<std::pair<double, Complex>> fits;  // the less the first value, the better
  for (int shift = 0; shift < kSamples; ++shift) {
    const double size = std::abs(sums[shift]);
    const double beside =
        std::max(std::abs(sums[(shift + 1) % kSamples]), std::abs(sums[(shift + kSamples - 1) % kSamples]));
    const double apart = std::sqrt(std::max(0.0, squares - 2 * size) / kSamples);
    if (size > 0 && size >= beside && apart <= farthest)
      fits.push_back({-size, std::conj(sums[shift]) / size});
  }
  std::sort(fits.begin(), fits.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  constexpr size_t kMost = 8;  // round pieces fit in several ways
  std::vector<Complex> turns;
  for (size_t k = 0; k < std::min(kMost, fits.size()); ++k) turns.push_back(fits[k].second);
  return turns;
}

bool AreCongruent(const Shape& a, const Shape& b, double tolerance) {
  constexpr double kOfSize = 0.03;
  const double most = std::min(tolerance, kOfSize * std::max(a.size, b.size));
  if (a.loops.size() != b.loops.size()) return false;
  if (std::abs(a.area - b.area) > most * std::max(a.length, b.length)) return false;
  if (std::abs(a.size - b.size) > 4 * most || MeanDifferenceOfRadii(a, b) > most) return false;
  // Samples stand a step apart at most, and wavy outlines have them a little further on or back.
  const double farthest = 2 * most + 2 * std::max(a.length, b.length) / kSamples;
  const std::vector<Complex> turns = LikelyTurns(a, b, farthest);
  // Samples and corners don't lie in the same places: both turn and place are only about right.
  constexpr int kSteps = 4;
  return std::any_of(turns.begin(), turns.end(), [&](const Complex& turn) {
    Pose pose{turn};
    for (int step = 0; step < kSteps; ++step) pose = Better(a.samples, pose, b.loops);
    return FarthestCorner(a.loops, pose, b.loops) <= most &&
           FarthestCorner(b.loops, pose.Inverse(), a.loops) <= most;
  });
}

}  // namespace

void FindCongruentPieces(double tolerance, Pattern& pattern) {
  std::vector<Shape> shapes;
  for (const Piece& piece : pattern.pieces) shapes.push_back(ShapeOf(piece, false));
  for (Piece& piece : pattern.pieces) {
    piece.group = piece.id;
    piece.mirrored = false;
    const Shape mirrored = ShapeOf(piece, true);
    for (int other = 0; other < piece.id; ++other) {
      if (pattern.pieces[other].group != other) continue;
      const bool same = AreCongruent(shapes[piece.id], shapes[other], tolerance);
      if (!same && !AreCongruent(mirrored, shapes[other], tolerance)) continue;
      piece.group = other;
      piece.mirrored = !same;
      break;
    }
  }
}

void CountCopies(bool merge, Pattern& pattern) {
  for (Piece& piece : pattern.pieces) {
    piece.drawn = !merge || piece.group == piece.id;
    piece.copies = piece.drawn ? 1 : 0;
    piece.mirror_copies = 0;
  }
  if (!merge) return;
  for (const Piece& piece : pattern.pieces) {
    if (piece.drawn) continue;
    Piece& first = pattern.pieces[piece.group];
    ++(piece.mirrored ? first.mirror_copies : first.copies);
  }
}

}  // namespace dcharts
