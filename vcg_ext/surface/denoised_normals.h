// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "surface/surface_graph.h"

namespace dcharts {

/// Estimates the noise of the vertices' places, as the standard deviation along the normal over the mean edge
/// length around a vertex: about 0.05 for noise of 5 % of the edges. What a shape does to it is small: less
/// than 0.025 on clean models, scans among them, unless they are very coarse. A vertex is compared with its
/// neighbours' umbrellas (their heights over the mean of their own neighbours), which differ little on a
/// smooth surface, curved or flat; creases and corners are in the upper part of the distribution, of which
/// only the lower third is read. 0 where too few vertices lie inside the surface to tell.
template <class MeshType>
double VertexNoise(const SurfaceGraph<MeshType>& surface) {
  constexpr int kFewest = 100;          // vertices: fewer are a shape, not a sample of noise
  constexpr double kShare = 0.3;        // of the area
  constexpr double kNoisePerRough = 2;  // measured on noise of known size
  const int vertex_count = surface.VertexCount();
  std::vector<double> height(vertex_count, 0), area(vertex_count, 0);
  std::vector<char> inside(vertex_count, 0);
  for (int v = 0; v < vertex_count; ++v) {
    const int *begin = surface.RingBegin(v), *end = surface.RingEnd(v);
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(), mean = Eigen::Vector3d::Zero();
    double length = 0;
    bool whole = begin != end;
    for (const int* h = begin; h != end; ++h) {
      whole = whole && surface.Opposite(*h) >= 0 && surface.Opposite(Previous(*h)) >= 0;
      normal += surface.Area(*h / 3) * surface.Normal(*h / 3);
      area[v] += surface.Area(*h / 3);
      mean += surface.Position(surface.Vertex(Next(*h))) - surface.Position(v);
      length += surface.Length(*h);
    }
    const double norm = normal.norm();
    if (!whole || !(norm > 0) || !(length > 0)) continue;
    inside[v] = 1;
    height[v] = mean.dot(normal) / (norm * length);
  }
  std::vector<std::pair<double, double>> rough;  // and the area it stands for
  double total = 0;
  for (int v = 0; v < vertex_count; ++v) {
    if (!inside[v]) continue;
    double mean = 0;
    int count = 0;
    for (const int* h = surface.RingBegin(v); h != surface.RingEnd(v); ++h) {
      const int w = surface.Vertex(Next(*h));
      if (!inside[w]) continue;
      mean += height[w];
      ++count;
    }
    if (count < 3) continue;
    rough.push_back({std::abs(height[v] - mean / count), area[v]});
    total += area[v];
  }
  if (static_cast<int>(rough.size()) < kFewest) return 0;
  std::sort(rough.begin(), rough.end());
  double below = 0;
  for (const auto& [value, weight] : rough)
    if ((below += weight) >= kShare * total) return kNoisePerRough * value;
  return kNoisePerRough * rough.back().first;
}

/// Takes the noise of the vertices out of the faces' normals and keeps creases: bilateral means (each normal
/// with those around it, weighted by area and likeness) tell which faces are on one side of a crease, then a
/// linear function of the place is fitted to the normals of each side, so that round shapes stay round.
template <class MeshType>
class NormalDenoiser {
 public:
  /// `noise` as of VertexNoise, > 0.
  NormalDenoiser(const SurfaceGraph<MeshType>& surface, double noise)
      : surface_(surface), range_(std::min(kUnlike * kTurnPerNoise * noise, kMostUnlike)) {
    FindNeighbours();
  }

  /// Unit length; faces without area keep their zero. Reads nothing of the faces' order but the last digits
  /// of sums.
  std::vector<Eigen::Vector3d> Run(const std::function<void()>& poll) const {
    // More of either wears down creases and tips.
    constexpr int kMeans = 2, kFits = 2;
    std::vector<Eigen::Vector3d> normals(surface_.FaceCount());
    for (int f = 0; f < surface_.FaceCount(); ++f) normals[f] = surface_.Normal(f);
    std::vector<Eigen::Vector3d> guide = normals;
    for (int k = 0; k < kMeans; ++k) guide = Means(guide, poll);
    for (int k = 0; k < kFits; ++k) guide = normals = Fits(normals, guide, poll);
    return normals;
  }

 private:
  // A vertex off by `noise` edges turns a face by about twice that, in radians; normals farther apart than
  // three times as much are of two sides, those of a crease of 45 degrees always.
  static constexpr double kTurnPerNoise = 2, kUnlike = 3, kMostUnlike = 0.4;
  static constexpr size_t kPollEvery = 65536;  // faces

  double Likeness(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    return std::exp(-(a - b).squaredNorm() / (2 * range_ * range_));
  }

  static Eigen::Vector3d Unit(const Eigen::Vector3d& sum, const Eigen::Vector3d& otherwise) {
    const double norm = sum.norm();
    return norm > 0 ? Eigen::Vector3d(sum / norm) : otherwise;
  }

  std::vector<Eigen::Vector3d> Means(const std::vector<Eigen::Vector3d>& normals,
                                     const std::function<void()>& poll) const {
    std::vector<Eigen::Vector3d> means(normals.size());
    for (size_t f = 0; f < normals.size(); ++f) {
      if (f % kPollEvery == 0) poll();
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int k = start_[f]; k < start_[f + 1]; ++k) {
        const Eigen::Vector3d& other = normals[around_[k]];
        sum += surface_.Area(around_[k]) * Likeness(normals[f], other) * other;
      }
      means[f] = normals[f].isZero(0) ? normals[f] : Unit(sum, normals[f]);
    }
    return means;
  }

  // Faces are on one side where those of `guide` are alike.
  std::vector<Eigen::Vector3d> Fits(const std::vector<Eigen::Vector3d>& normals,
                                    const std::vector<Eigen::Vector3d>& guide,
                                    const std::function<void()>& poll) const {
    // Where all lie in one line, or nearly, the slope across it is unknown: it is drawn to 0.
    constexpr double kRidge = 0.1;
    std::vector<Eigen::Vector3d> fits = normals;
    for (size_t f = 0; f < normals.size(); ++f) {
      if (f % kPollEvery == 0) poll();
      if (guide[f].isZero(0)) continue;
      const Eigen::Vector3d u = guide[f].unitOrthogonal(), v = guide[f].cross(u);
      Eigen::Matrix3d left = Eigen::Matrix3d::Zero(), right = Eigen::Matrix3d::Zero();
      for (int k = start_[f]; k < start_[f + 1]; ++k) {
        const int g = around_[k];
        const double weight = surface_.Area(g) * Likeness(guide[f], guide[g]);
        const Eigen::Vector3d step = surface_.Centroid(g) - surface_.Centroid(static_cast<int>(f));
        const Eigen::Vector3d row(1, step.dot(u), step.dot(v));
        left += weight * row * row.transpose();
        right += weight * row * normals[g].transpose();
      }
      const double ridge = kRidge * (left(1, 1) + left(2, 2));
      left(1, 1) += ridge;
      left(2, 2) += ridge;
      fits[f] = Unit(left.ldlt().solve(right).row(0), normals[f]);
    }
    return fits;
  }

  // The faces that share a vertex with each, itself among them.
  void FindNeighbours() {
    std::vector<int> stamp(surface_.FaceCount(), -1);
    start_.assign(1, 0);
    for (int f = 0; f < surface_.FaceCount(); ++f) {
      for (int i = 0; i < 3; ++i) {
        const int v = surface_.Vertex(3 * f + i);
        for (const int* h = surface_.RingBegin(v); h != surface_.RingEnd(v); ++h) {
          if (stamp[*h / 3] == f) continue;
          stamp[*h / 3] = f;
          around_.push_back(*h / 3);
        }
      }
      start_.push_back(static_cast<int>(around_.size()));
    }
  }

  const SurfaceGraph<MeshType>& surface_;
  const double range_;
  std::vector<int> start_, around_;  // of face f: around_[start_[f]] up to around_[start_[f + 1]]
};

/// Where the surface is noisy (scans), gives its faces denoised normals, for the analysis only: no vertex
/// moves. Others stay as they are to the last bit. True where it was noisy. `poll` is called now and then and
/// may throw.
template <class MeshType>
bool DenoiseNormals(
    SurfaceGraph<MeshType>& surface, const std::function<void()>& poll = [] {}) {
  constexpr double kNoisy = 0.035;  // of the edges; clean scans are below 0.025
  const double noise = VertexNoise(surface);
  poll();
  if (noise < kNoisy) return false;
  surface.SetNormals(NormalDenoiser<MeshType>(surface, noise).Run(poll));
  return true;
}

}  // namespace dcharts
