// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/coarse_chart.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/half_edge.h"
#include "common/parallel.h"
#include "planar/vertex_descent.h"

namespace dcharts {
namespace {

std::size_t At(int i) { return static_cast<std::size_t>(i); }

std::vector<int> Opposites(const Triangles& triangles) {
  const int count = 3 * static_cast<int>(triangles.rows());
  const auto vertex = [&](int h) { return triangles(h / 3, h % 3); };
  // Half-edges by the smaller of their two vertices, in order.
  std::vector<int> first(At(triangles.maxCoeff()) + 2, 0), sorted(At(count)), opposite(At(count), -1);
  const auto key = [&](int h) { return At(std::min(vertex(h), vertex(Next(h)))); };
  for (int h = 0; h < count; ++h) ++first[key(h) + 1];
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<int> next(first.begin(), first.end() - 1);
  for (int h = 0; h < count; ++h) sorted[At(next[key(h)]++)] = h;
  for (int h = 0; h < count; ++h)
    for (int k = first[key(h)]; k < first[key(h) + 1]; ++k) {
      const int g = sorted[At(k)];
      if (vertex(g) == vertex(Next(h)) && vertex(Next(g)) == vertex(h)) opposite[At(h)] = g;
    }
  return opposite;
}

// The part of a convex polygon left of the line from `a` to `b`.
void ClipLeftOf(const Complex& a, const Complex& b, PlanePoints& polygon, PlanePoints& clipped) {
  clipped.clear();
  const auto side = [&](const Complex& z) { return Cross(b - a, z - a); };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Complex &z = polygon[k], &w = polygon[(k + 1) % polygon.size()];
    const double sz = side(z), sw = side(w);
    if (sz >= 0) clipped.push_back(z);
    if ((sz > 0 && sw < 0) || (sz < 0 && sw > 0)) clipped.push_back(z + sz / (sz - sw) * (w - z));
  }
  polygon.swap(clipped);
}

// A point well inside of what sees all edges of the fan.
Complex InsideKernel(const std::vector<FanTriangle>& fan) {
  double low[2] = {fan[0].z1.real(), fan[0].z1.imag()}, high[2] = {low[0], low[1]};
  for (const FanTriangle& t : fan)
    for (const Complex& z : {t.z1, t.z2}) {
      low[0] = std::min(low[0], z.real());
      low[1] = std::min(low[1], z.imag());
      high[0] = std::max(high[0], z.real());
      high[1] = std::max(high[1], z.imag());
    }
  const double margin = std::max(high[0] - low[0], high[1] - low[1]);
  for (int d : {0, 1}) {
    low[d] -= margin;
    high[d] += margin;
  }
  PlanePoints polygon{{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}}, clipped;
  for (const FanTriangle& t : fan) ClipLeftOf(t.z1, t.z2, polygon, clipped);
  Complex sum = 0;
  for (const Complex& z : polygon) sum += z;
  return polygon.empty() ? Complex(NAN, NAN) : sum / static_cast<double>(polygon.size());
}

}  // namespace

CoarseChart::CoarseChart(const ChartMesh& chart, int target_faces, const std::function<void()>& poll)
    : chart_(chart) {
  FannedSurface surface;
  const int face_count = static_cast<int>(chart.triangles.rows());
  for (int v = 0; v < chart.positions.rows(); ++v) {
    surface.positions.push_back(chart.positions.row(v));
    surface.source_vertex.push_back(v);
  }
  surface.vertex.assign(chart.triangles.data(), chart.triangles.data() + 3 * face_count);
  surface.opposite = Opposites(chart.triangles);
  CoarsenedSurface left = Coarsened(surface, ChartIds(At(face_count), 0), target_faces, &history_, poll);
  source_face_ = std::move(left.source_face);
  opposite_ = std::move(left.opposite);
  std::vector<int> new_vertex(surface.positions.size(), -1);
  for (int v : left.vertex) new_vertex[At(v)] = 0;
  for (int v = 0; v < chart.positions.rows(); ++v) {
    if (new_vertex[At(v)] < 0) continue;
    new_vertex[At(v)] = static_cast<int>(source_.size());
    source_.push_back(v);
  }
  mesh_.positions.resize(static_cast<int>(source_.size()), 3);
  for (int v = 0; v < static_cast<int>(source_.size()); ++v)
    mesh_.positions.row(v) = chart.positions.row(source_[At(v)]);
  mesh_.triangles.resize(static_cast<int>(source_face_.size()), 3);
  for (int h = 0; h < static_cast<int>(left.vertex.size()); ++h)
    mesh_.triangles(h / 3, h % 3) = new_vertex[At(left.vertex[At(h)])];
}

bool CoarseChart::Continue(int begin, int end, const RestFloors& floors, const std::function<void()>& poll,
                           PlanePoints& map) const {
  const StretchEnergy energy{StretchEnergy::Kind::kSander};
  std::vector<FanTriangle> fan;
  constexpr int kPollEvery = 4096;  // vertices
  for (int s = end; s-- > begin;) {
    if (poll && s % kPollEvery == 0) poll();
    const CollapseHistory::Step& step = history_.steps[At(s)];
    const int* ring = history_.rings.data() + step.ring_begin;
    const int size = RingEnd(s) - step.ring_begin;
    fan.clear();
    // Where the triangles want the vertex, each laid rigidly beside its edge of the ring.
    Complex wanted = 0;
    double weight = 0;
    for (int k = 0; k < (step.closed ? size : size - 1); ++k) {
      const int a = ring[k], b = ring[(k + 1) % size];
      const Eigen::Vector3d corner[3] = {chart_.positions.row(step.vertex), chart_.positions.row(a),
                                         chart_.positions.row(b)};
      FanTriangle triangle{RestShapeOf(corner, floors), map[At(a)], map[At(b)]};
      const Eigen::Vector3d along = corner[2] - corner[1], side = corner[0] - corner[1];
      const Complex edge = triangle.z2 - triangle.z1;
      const double length = along.norm(), flat_length = std::abs(edge);
      if (length > 0 && flat_length > 0) {
        const Complex place(along.dot(side) / length, along.cross(side).norm() / length);
        const Complex middle = 0.5 * (triangle.z1 + triangle.z2);
        wanted += triangle.shape.weight * (middle + Mul(edge / flat_length, place - 0.5 * length));
        weight += triangle.shape.weight;
      }
      fan.push_back(triangle);
    }
    Complex z = weight > 0 ? wanted / weight : InsideKernel(fan);
    double value = FanEnergy(energy, fan, z);
    if (!std::isfinite(value)) {
      z = InsideKernel(fan);
      value = FanEnergy(energy, fan, z);
      if (!std::isfinite(value)) return false;
    }
    constexpr int kSteps = 2;
    for (int k = 0; k < kSteps; ++k) ImproveVertex(energy, fan, z, value);
    map[At(step.vertex)] = z;
  }
  return true;
}

std::optional<PlanePoints> CoarseChart::Continued(const Points2& uv,
                                                  const std::function<void()>& poll) const {
  PlanePoints map(At(static_cast<int>(chart_.positions.rows())));
  for (int v = 0; v < static_cast<int>(source_.size()); ++v) map[At(source_[At(v)])] = {uv(v, 0), uv(v, 1)};
  const RestFloors floors = RestFloorsOf(chart_);
  int end = static_cast<int>(history_.steps.size());
  for (auto phase = history_.phases.rbegin(); phase != history_.phases.rend(); ++phase) {
    std::vector<int> bounds = *phase;
    bounds.push_back(end);
    end = bounds.front();
    const int count = static_cast<int>(phase->size());
    std::vector<char> done(At(count), 0);
    InParallel(count, poll, [&](int run, const std::function<void()>& poll_run) {
      done[At(run)] = Continue(bounds[At(run)], bounds[At(run) + 1], floors, poll_run, map);
    });
    if (std::count(done.begin(), done.end(), 0) > 0) return std::nullopt;
  }
  return map;
}

}  // namespace dcharts
