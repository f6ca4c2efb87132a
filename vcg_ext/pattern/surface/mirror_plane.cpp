// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/mirror_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <Eigen/Eigenvalues>

namespace dcharts {
namespace {

using Surface = SurfaceGraph<SurfaceMesh>;

/// Finds the face whose centroid is next to a point and that looks the same way.
class FaceFinder {
 public:
  explicit FaceFinder(const Surface& surface) : surface_(surface) {
    edge_ = 0;
    for (int h = 0; h < surface.HalfEdgeCount(); ++h) edge_ += surface.Length(h) / surface.HalfEdgeCount();
    for (int f = 0; f < surface.FaceCount(); ++f) cells_[CellOf(surface.Centroid(f))].push_back(f);
  }

  double MeanEdge() const { return edge_; }

  // -1: none within two mean edges.
  int Find(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    const Cell cell = CellOf(p);
    int best = -1;
    double nearest = 4 * edge_ * edge_;
    for (int x = cell[0] - 1; x <= cell[0] + 1; ++x)
      for (int y = cell[1] - 1; y <= cell[1] + 1; ++y)
        for (int z = cell[2] - 1; z <= cell[2] + 1; ++z) {
          const auto found = cells_.find({x, y, z});
          if (found == cells_.end()) continue;
          for (int f : found->second) {
            const double distance = (surface_.Centroid(f) - p).squaredNorm();
            if (distance >= nearest || surface_.Normal(f).dot(normal) < 0.5) continue;
            nearest = distance;
            best = f;
          }
        }
    return best;
  }

 private:
  using Cell = std::array<int, 3>;
  Cell CellOf(const Eigen::Vector3d& p) const {
    const double size = 2 * edge_;
    return {static_cast<int>(std::floor(p.x() / size)), static_cast<int>(std::floor(p.y() / size)),
            static_cast<int>(std::floor(p.z() / size))};
  }

  const Surface& surface_;
  double edge_ = 1;
  std::map<Cell, std::vector<int>> cells_;
};

Eigen::Vector3d MirroredNormal(const MirrorPlane& mirror, const Eigen::Vector3d& n) {
  return n - 2 * mirror.normal.dot(n) * mirror.normal;
}

struct Likeness {
  double share = 0;  // of the area that has a mirror image
  double apart = 0;  // mean distance of the middles of faces to those of their images, in mean edges
  double Score() const { return share - 0.1 * apart; }
};

/// The plane that fits pairs of points and the faces that their images are on: Gauss-Newton.
class PlaneFit {
 public:
  explicit PlaneFit(const MirrorPlane& mirror) : mirror_(mirror), u_(mirror.normal.unitOrthogonal()) {
    v_ = mirror.normal.cross(u_);
  }

  // `image`: a point of the surface near the mirror image of `p`, with the surface's normal there.
  void Add(const Eigen::Vector3d& p, const Eigen::Vector3d& image, const Eigen::Vector3d& normal,
           double weight) {
    // Along the surface triangles lie as they like: that counts only where nothing else tells.
    constexpr double kAlong = 0.01;
    const Eigen::Vector3d apart = mirror_.Mirrored(p) - image;
    Eigen::Matrix3d turn;  // how the mirrored point moves with the normal, along u and v, and the offset
    turn.col(0) = -2 * (mirror_.Height(p) * u_ + u_.dot(p) * mirror_.normal);
    turn.col(1) = -2 * (mirror_.Height(p) * v_ + v_.dot(p) * mirror_.normal);
    turn.col(2) = 2 * mirror_.normal;
    const Eigen::RowVector3d across = normal.transpose() * turn;
    left_ += weight * (across.transpose() * across + kAlong * turn.transpose() * turn);
    right_ -= weight * (across.transpose() * normal.dot(apart) + kAlong * turn.transpose() * apart);
  }

  MirrorPlane Better() const {
    const Eigen::Vector3d step = left_.ldlt().solve(right_);
    MirrorPlane better;
    if (!step.allFinite()) return mirror_;
    better.normal = mirror_.normal + step[0] * u_ + step[1] * v_;
    const double length = better.normal.norm();
    better.normal /= length;
    better.offset = (mirror_.offset + step[2]) / length;
    return better;
  }

 private:
  const MirrorPlane mirror_;
  Eigen::Vector3d u_, v_;
  Eigen::Matrix3d left_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
};

// Of every `stride`-th face. With `better`, also the plane that fits the pairs.
Likeness LikenessOf(const Surface& surface, const FaceFinder& finder, const MirrorPlane& mirror, int stride,
                    MirrorPlane* better) {
  double good = 0, all = 0, apart = 0;
  PlaneFit fit(mirror);
  for (int f = 0; f < surface.FaceCount(); f += stride) {
    all += surface.Area(f);
    const Eigen::Vector3d p = mirror.Mirrored(surface.Centroid(f));
    const int g = finder.Find(p, MirroredNormal(mirror, surface.Normal(f)));
    if (g < 0) continue;
    // Along the surface the triangles may lie as they like.
    constexpr double kOff = 0.35;   // of an edge's length: noise of 5 % and coarse curved faces are within
    constexpr double kApart = 0.8;  // of an edge's length: beyond a border there is no image
    const double distance = (p - surface.Centroid(g)).norm() / finder.MeanEdge();
    if (better != nullptr)
      fit.Add(surface.Centroid(f), surface.Centroid(g), surface.Normal(g), surface.Area(f));
    if (distance > kApart) continue;
    if (std::abs(surface.Normal(g).dot(p - surface.Centroid(g))) > kOff * finder.MeanEdge()) continue;
    good += surface.Area(f);
    apart += surface.Area(f) * distance;
  }
  if (better != nullptr) *better = fit.Better();
  if (!(good > 0)) return {};
  return {good / all, apart / good};
}

}  // namespace

std::optional<MirrorPlane> FindMirrorPlane(const Surface& surface) {
  const FaceFinder finder(surface);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int f = 0; f < surface.FaceCount(); ++f)
    middle += surface.Area(f) / surface.TotalArea() * surface.Centroid(f);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (int f = 0; f < surface.FaceCount(); ++f) {
    const Eigen::Vector3d d = surface.Centroid(f) - middle;
    spread += surface.Area(f) * d * d.transpose();
  }
  // Planes across the main axes; those of a cube or a ball are arbitrary, so those of the coordinates too.
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  constexpr int kSamples = 3000, kRefinements = 8;
  constexpr double kLikely = 0.5, kMirrored = 0.99;
  const int stride = std::max(1, surface.FaceCount() / kSamples);
  std::optional<MirrorPlane> best;
  double best_score = 0;
  for (int k = 0; k < 6; ++k) {
    MirrorPlane mirror;
    mirror.normal = k < 3 ? Eigen::Vector3d(axes.col(k)) : Eigen::Vector3d(Eigen::Vector3d::Unit(k - 3));
    mirror.offset = mirror.normal.dot(middle);
    for (int step = 0; step < kRefinements; ++step) {
      MirrorPlane better;
      const Likeness likeness = LikenessOf(surface, finder, mirror, stride, &better);
      if (!(likeness.share > 0) || (likeness.share < kLikely && step > 2)) break;
      mirror = better;
    }
    const Likeness likeness = LikenessOf(surface, finder, mirror, stride, nullptr);
    constexpr double kClearly = 1e-3;  // of equally good planes the first
    if (likeness.share < kMirrored || (best && likeness.Score() < best_score + kClearly)) continue;
    best_score = likeness.Score();
    best = mirror;
  }
  if (!best) return best;
  // The same direction for the same surface.
  int largest = 0;
  best->normal.cwiseAbs().maxCoeff(&largest);
  if (best->normal[largest] < 0) {
    best->normal = -best->normal;
    best->offset = -best->offset;
  }
  return best;
}

}  // namespace dcharts
