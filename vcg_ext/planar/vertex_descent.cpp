// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/vertex_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/parallel.h"
#include "common/union_find.h"
#include "planar/contractions.h"
#include "planar/line_search.h"
#include "planar/vertex_block_system.h"

namespace dcharts {
namespace {

constexpr double kRegularization = 1e-8;  // of the mean diagonal
constexpr double kShareOfWayToFlip = 0.9;
constexpr double kArmijo = 1e-4;
constexpr int kMaxHalvings = 12;

std::size_t At(int i) { return static_cast<std::size_t>(i); }

// The longest step along `direction` that turns no triangle over.
double WayToFlip(const std::vector<FanTriangle>& fan, const Complex& z, const Complex& direction) {
  double way = std::numeric_limits<double>::infinity();
  for (const FanTriangle& t : fan) {
    const Complex e1 = t.z1 - z, e2 = t.z2 - z;
    const double loss = Cross(direction, e2) + Cross(e1, direction);
    if (loss > 0) way = std::min(way, Cross(e1, e2) / loss);
  }
  return way;
}

}  // namespace

RestShape SeenFromCorner(const RestShape& shape, int k) {
  if (k == 0) return shape;
  RestShape turned = shape;
  const Complex a0 = -shape.a1 - shape.a2;
  turned.a1 = k == 1 ? shape.a2 : a0;
  turned.a2 = k == 1 ? a0 : shape.a1;
  return turned;
}

double FanEnergy(const StretchEnergy& energy, const std::vector<FanTriangle>& fan, const Complex& z) {
  double sum = 0;
  for (const FanTriangle& t : fan)
    sum += t.shape.weight * TriangleEnergy(energy, t.shape, t.z1 - z, t.z2 - z);
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

void ImproveVertex(const StretchEnergy& energy, const std::vector<FanTriangle>& fan, Complex& z,
                   double& value) {
  Complex gradient = 0;
  double m00 = 0, m01 = 0, m11 = 0;
  for (const FanTriangle& t : fan) {
    const TriangleDerivatives d = ProjectedDerivatives(energy, t.shape, t.z1 - z, t.z2 - z);
    // As in stretch_descent.cpp, for the one vertex.
    const Complex a = -t.shape.a1 - t.shape.a2;
    const Complex product = Mul(a, a);
    const double turned = std::norm(a);
    gradient += ConjMul(a, d.gradient_alpha) + Mul(a, d.gradient_beta);
    const Complex linear = (d.m_alpha + d.m_beta) * turned + 2 * ConjMul(product, d.cross_linear).real();
    const Complex antilinear =
        Mul(d.d_alpha, std::conj(product)) + Mul(d.d_beta, product) + 2 * turned * d.cross_antilinear;
    const Block2 block = BlockOf(linear, antilinear);
    m00 += block.m00;
    m01 += block.m01;
    m11 += block.m11;
  }
  const double floor = kRegularization * 0.5 * (m00 + m11);
  m00 += floor;
  m11 += floor;
  const double determinant = m00 * m11 - m01 * m01;
  if (!(determinant > 0)) return;
  const Complex direction((m01 * gradient.imag() - m11 * gradient.real()) / determinant,
                          (m01 * gradient.real() - m00 * gradient.imag()) / determinant);
  const double slope = Dot(gradient, direction);
  if (!(slope < 0)) return;
  double step = std::min(1.0, kShareOfWayToFlip * WayToFlip(fan, z, direction));
  for (int halving = 0; halving < kMaxHalvings; ++halving, step *= 0.5) {
    const Complex moved = z + step * direction;
    const double moved_value = FanEnergy(energy, fan, moved);
    if (!(moved_value <= value + kArmijo * step * slope) || !(moved_value < value)) continue;
    z = moved;
    value = moved_value;
    return;
  }
}

VertexSweeps::VertexSweeps(int vertex_count, const Triangles& triangles, const RestShapes& shapes)
    : triangles_(triangles), shapes_(shapes), first_(At(vertex_count) + 1, 0), corners_(shapes.size() * 3) {
  const int corner_count = static_cast<int>(corners_.size());
  const auto vertex = [&](int corner) { return At(triangles(corner / 3, corner % 3)); };
  for (int c = 0; c < corner_count; ++c) ++first_[vertex(c) + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int c = 0; c < corner_count; ++c) corners_[At(next[vertex(c)]++)] = c;
}

double VertexSweeps::Step(const StretchEnergy& energy, int vertex, std::vector<FanTriangle>& fan,
                          PlanePoints& uv) const {
  fan.clear();
  for (int k = first_[At(vertex)]; k < first_[At(vertex) + 1]; ++k) {
    const int c = corners_[At(k)], t = c / 3, i = c % 3;
    fan.push_back({SeenFromCorner(shapes_[At(t)], i), uv[At(triangles_(t, (i + 1) % 3))],
                   uv[At(triangles_(t, (i + 2) % 3))]});
  }
  const double before = FanEnergy(energy, fan, uv[At(vertex)]);
  double after = before;
  ImproveVertex(energy, fan, uv[At(vertex)], after);
  return before - after;
}

std::vector<std::vector<int>> VertexSweeps::Halves() const {
  const int count = static_cast<int>(first_.size()) - 1, middle = count / 2;
  std::vector<std::vector<int>> parts(3);
  for (int v = 0; v < count; ++v) {
    bool inside = true;
    for (int k = first_[At(v)]; k < first_[At(v) + 1]; ++k)
      for (int i = 0; i < 3; ++i)
        inside = inside && (triangles_(corners_[At(k)] / 3, i) < middle) == (v < middle);
    parts[inside ? (v < middle ? 0 : 1) : 2].push_back(v);
  }
  return parts;
}

void VertexSweeps::EvenOut(const std::function<void()>& poll, PlanePoints& uv) const {
  constexpr int kMostSweeps = 10;
  constexpr double kLittle = 1e-2;          // share of the energy
  constexpr std::size_t kPollEvery = 4096;  // vertices
  const StretchEnergy energy{StretchEnergy::Kind::kSander};
  double value = MapEnergy(energy, triangles_, shapes_, uv);
  const std::vector<std::vector<int>> parts = Halves();
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double gain[3] = {0, 0, 0};
    const auto step_all = [&](int part, const std::function<void()>& poll_part) {
      std::vector<FanTriangle> fan;
      const std::vector<int>& vertices = parts[At(part)];
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        if (poll_part && k % kPollEvery == 0) poll_part();
        gain[part] += Step(energy, vertices[k], fan, uv);
      }
    };
    InParallel(2, poll, step_all);
    step_all(2, poll);
    const double sum = gain[0] + gain[1] + gain[2];
    value -= sum;
    if (!(sum > kLittle * value)) return;
  }
}

std::vector<double> VertexSweeps::Contractions(const std::function<void()>& poll,
                                               const PlanePoints& uv) const {
  constexpr int kBlock = 16384;
  const int count = static_cast<int>(shapes_.size());
  std::vector<double> contractions(shapes_.size(), 0);
  InParallel((count + kBlock - 1) / kBlock, poll, [&](int block, const std::function<void()>&) {
    for (int t = kBlock * block; t < std::min(kBlock * (block + 1), count); ++t)
      contractions[At(t)] = ContractionOf(triangles_, shapes_, uv, t);
  });
  return contractions;
}

std::vector<std::vector<int>> VertexSweeps::Clusters(const std::vector<int>& vertices) const {
  std::vector<int> place(first_.size() - 1, -1);
  for (std::size_t k = 0; k < vertices.size(); ++k) place[At(vertices[k])] = static_cast<int>(k);
  UnionFind sets(static_cast<int>(vertices.size()));
  for (std::size_t k = 0; k < vertices.size(); ++k)
    for (int c = first_[At(vertices[k])]; c < first_[At(vertices[k]) + 1]; ++c)
      for (int i = 0; i < 3; ++i) {
        const int other = place[At(triangles_(corners_[At(c)] / 3, i))];
        if (other >= 0) sets.Join(static_cast<int>(k), other);
      }
  std::vector<std::vector<int>> clusters;
  std::vector<int> cluster(vertices.size(), -1);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    int& c = cluster[At(sets.Find(static_cast<int>(k)))];
    if (c < 0) {
      c = static_cast<int>(clusters.size());
      clusters.emplace_back();
    }
    clusters[At(c)].push_back(vertices[k]);
  }
  return clusters;
}

void VertexSweeps::LowerWorst(const std::function<void()>& poll, PlanePoints& uv) const {
  constexpr int kMostRounds = 60, kSweepsPerRound = 4, kPatience = 3;
  constexpr double kReference = 0.85, kLittle = 0.01;  // of the worst
  constexpr std::size_t kMost = 10;  // one vertex of so many moves: only a few places are bad
  double least = std::numeric_limits<double>::infinity();
  int without_gain = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    if (poll) poll();
    const std::vector<double> contractions = Contractions(poll, uv);
    const double worst = *std::max_element(contractions.begin(), contractions.end());
    without_gain = worst < (1 - kLittle) * least ? 0 : without_gain + 1;
    if (without_gain == kPatience || !(worst > 0)) return;
    least = std::min(least, worst);
    std::vector<int> vertices;
    for (const double bad : {0.3, 0.5, 0.7, 0.85}) {
      vertices = VerticesNear(contractions, bad * worst);
      if (kMost * vertices.size() <= uv.size()) break;
      vertices.clear();
    }
    if (vertices.empty()) return;
    const StretchEnergy energy{StretchEnergy::Kind::kSanderTail, 12, kReference * worst};
    const std::vector<std::vector<int>> clusters = Clusters(vertices);
    InParallel(static_cast<int>(clusters.size()), poll, [&](int k, const std::function<void()>&) {
      std::vector<FanTriangle> fan;
      for (int sweep = 0; sweep < kSweepsPerRound; ++sweep)
        for (int v : clusters[At(k)]) Step(energy, v, fan, uv);
    });
  }
}

std::vector<int> VertexSweeps::VerticesNear(const std::vector<double>& contractions, double bound) const {
  const std::vector<char> near = NearContracted(triangles_, contractions, first_.size() - 1, bound, 1);
  std::vector<int> vertices;
  for (int v = 0; v < static_cast<int>(near.size()); ++v)
    if (near[At(v)]) vertices.push_back(v);
  return vertices;
}

}  // namespace dcharts
