// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/smooth_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "pattern/surface/data_coordinates.h"

namespace dcharts {
namespace {

using Surface = SurfaceGraph<SurfaceMesh>;

class SeamSmoother {
 public:
  SeamSmoother(const Surface& surface, const SeamMask& seams)
      : surface_(surface), position_(surface.VertexCount()), next_(surface.VertexCount(), {-1, -1}) {
    for (int v = 0; v < surface.VertexCount(); ++v) position_[v] = surface.Position(v);
    std::vector<int> degree(surface.VertexCount(), 0);
    std::vector<char> fixed(surface.VertexCount(), 0);
    for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
      const int v = surface.Vertex(h), w = surface.Vertex(Next(h)), o = surface.Opposite(h);
      if (o < 0) fixed[v] = fixed[w] = 1;
      if (o < h || !IsSeam(seams, h)) continue;
      for (const auto& [at, to] : {std::array<int, 2>{v, w}, std::array<int, 2>{w, v}}) {
        if (degree[at] < 2) next_[at][degree[at]] = to;
        ++degree[at];
      }
    }
    for (int v = 0; v < surface.VertexCount(); ++v) {
      if (degree[v] != 2 || fixed[v]) continue;
      if (IsSmooth(v))
        free_.push_back({v, false});
      else if (IsOnCrease(v, seams))
        free_.push_back({v, true});
    }
  }

  void Run() {
    constexpr int kRounds = 20;
    for (int round = 0; round < kRounds; ++round)
      for (const Free& free : free_) Move(free);
  }

  const Eigen::Vector3d& Position(int v) const { return position_[v]; }

 private:
  // No sharp edge of the model runs through the vertex.
  bool IsSmooth(int v) const {
    constexpr double kSharp = 0.8;  // cosine of 37 degrees
    const Eigen::Vector3d normal = NormalAt(v);
    return std::all_of(surface_.RingBegin(v), surface_.RingEnd(v),
                       [&](int h) { return surface_.Normal(h / 3).dot(normal) > kSharp; });
  }

  // The seam runs along a sharp edge of the model, and no other meets there.
  bool IsOnCrease(int v, const SeamMask& seams) const {
    constexpr double kSharp = 0.7;  // cosine of 46 degrees
    int creases = 0;
    for (const int* h = surface_.RingBegin(v); h != surface_.RingEnd(v); ++h) {
      if (surface_.Opposite(*h) < 0) return false;
      if (surface_.Normal(*h / 3).dot(surface_.Normal(surface_.Neighbour(*h))) > kSharp) continue;
      if (!IsSeam(seams, *h)) return false;
      ++creases;
    }
    return creases == 2;
  }

  Eigen::Vector3d NormalAt(int v) const {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (const int* h = surface_.RingBegin(v); h != surface_.RingEnd(v); ++h)
      normal += surface_.Area(*h / 3) * surface_.Normal(*h / 3);
    return normal.normalized();
  }

  // One in the seam.
  struct Free {
    int vertex;
    bool on_crease;
  };

  void Move(const Free& free) {
    constexpr double kShare = 0.5;
    const int v = free.vertex;
    const Eigen::Vector3d normal = NormalAt(v), old = position_[v];
    Eigen::Vector3d step = StepOf(v);
    if (!free.on_crease)
      step -= normal.dot(step) * normal;
    else if (!IsTooth(v, step))
      return;
    for (double share = kShare; share > 0.1; share /= 2) {
      position_[v] = old + share * step;
      if (std::all_of(surface_.RingBegin(v), surface_.RingEnd(v), [&](int h) { return IsSound(h / 3); }))
        return;
    }
    position_[v] = old;
  }

  // To the middle between its neighbours.
  Eigen::Vector3d StepOf(int v) const {
    if (next_[v][1] < 0) return Eigen::Vector3d::Zero();
    return (position_[next_[v][0]] + position_[next_[v][1]]) / 2 - position_[v];
  }

  // The crease bends one way here and the other way at both neighbours: a curve of the model does not. And it
  // is not far from where it was.
  bool IsTooth(int v, const Eigen::Vector3d& step) const {
    constexpr double kDeepest = 0.5;  // of the shortest edge
    return step.dot(StepOf(next_[v][0])) < 0 && step.dot(StepOf(next_[v][1])) < 0 &&
           (position_[v] + step / 2 - surface_.Position(v)).norm() < kDeepest * LeastLength(v);
  }

  double LeastLength(int v) const {
    double least = std::numeric_limits<double>::infinity();
    for (const int* h = surface_.RingBegin(v); h != surface_.RingEnd(v); ++h)
      least = std::min(least, surface_.Length(*h));
    return least;
  }

  // The face looks where it did and hasn't lost most of its area.
  bool IsSound(int f) const {
    constexpr double kLeastArea = 0.15, kLeastCosine = 0.9;
    const Eigen::Vector3d &a = position_[surface_.Vertex(3 * f)], &b = position_[surface_.Vertex(3 * f + 1)],
                          &c = position_[surface_.Vertex(3 * f + 2)];
    const Eigen::Vector3d n = (b - a).cross(c - a);
    const double area = n.norm() / 2;
    return area > kLeastArea * surface_.Area(f) && n.dot(surface_.Normal(f)) > kLeastCosine * 2 * area;
  }

  const Surface& surface_;
  std::vector<Eigen::Vector3d> position_;
  std::vector<std::array<int, 2>> next_;  // the neighbours along the seam
  std::vector<Free> free_;
};

}  // namespace

SurfaceData WithSmoothSeams(const SurfaceData& data, const Surface& surface, const SeamMask& seams) {
  SeamSmoother smoother(surface, seams);
  smoother.Run();
  const double scale = DataCoordinates(data, surface).Scale();
  SurfaceData smooth = data;
  for (int v = 0; v < surface.VertexCount(); ++v) {
    const Eigen::Vector3d moved = scale * (smoother.Position(v) - surface.Position(v));
    for (int d = 0; d < 3; ++d) smooth.vertices[v][d] += moved[d];
  }
  return smooth;
}

}  // namespace dcharts
