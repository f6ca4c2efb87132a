// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/coarsener.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "common/half_edge.h"
#include "planar/border_lines.h"
#include "planar/quadric.h"

namespace dcharts {
namespace {

using Eigen::Vector3d;
using Spoke = CollapsingMesh::Spoke;

// Chosen so that on scanned models the stretch of flattened charts, and of pairs of them, comes out as on the
// fine mesh.
constexpr int kLeastFaces = 30;          // that a chart keeps
constexpr double kBorderWeight = 3;      // of leaving a border line, against leaving the surface
constexpr double kEvenWeight = 5e-3;     // of the length moved, against the distance to the surface
constexpr double kShapeWeight = 4;       // of thin faces
constexpr double kLeastQuality = 0.05;   // of a face that was better before
constexpr double kLeastCosine = 0.7;     // between a face's normals before and after a step
constexpr int kMostSpokes = 14;          // of a vertex that had fewer before
constexpr double kSmallestChart = 1e-3;  // area, in parts of the mean; below it charts count as this large
constexpr double kNoArea = 1e-9;         // quality of a face that is a line
constexpr double kNever = std::numeric_limits<double>::infinity();

struct Shape {
  Vector3d normal;  // not of unit length
  double quality;   // 1 for an equilateral triangle, 0 for one without area
};

Shape ShapeOf(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a;
  Shape shape;
  shape.normal = ab.cross(ac);
  const double squares = ab.squaredNorm() + ac.squaredNorm() + (c - b).squaredNorm();
  constexpr double kTwoSqrt3 = 3.4641016151377546;
  shape.quality = squares > 0 ? kTwoSqrt3 * shape.normal.norm() / squares : 0;
  return shape;
}

class Coarsener {
 public:
  Coarsener(const FannedSurface& surface, const ChartIds& ids, const std::function<void()>& poll)
      : surface_(surface),
        ids_(ids),
        poll_(poll),
        fixed_(FixedVertices(surface)),
        mesh_(surface.vertex, surface.opposite, static_cast<int>(surface.positions.size())),
        lines_(mesh_, ids_, fixed_) {}

  void Run(int target_faces, CollapseHistory* history) {
    history_ = history;
    heir_.resize(ids_.size());
    std::iota(heir_.begin(), heir_.end(), 0);
    Normalize();
    CountFaces();
    SumQuadrics();
    key_.assign(positions_.size(), kNever);
    for (int v = 0; v < static_cast<int>(positions_.size()); ++v) {
      PollNowAndThen(v);
      Push(v, LeastBound(v));
    }
    int steps = 0;
    while (!queue_.empty() && mesh_.FaceCount() > target_faces) {
      PollNowAndThen(steps++);
      const auto [key, u] = queue_.top();
      queue_.pop();
      if (key != key_[u] || !mesh_.VertexLives(u)) continue;
      Spoke best{-1, -1};
      const double cost = BestCollapse(u, best);
      key_[u] = kNever;
      if (best.vertex < 0) continue;
      // The key was only a lower bound.
      if (!queue_.empty() && cost > queue_.top().first)
        Push(u, cost);
      else
        Collapse(u, best);
    }
  }

  CoarsenedSurface Take() {
    for (int f = 0; f < static_cast<int>(heir_.size()); ++f) {
      int last = f;
      while (!mesh_.FaceLives(last)) last = heir_[last];
      for (int g = f; g != last;) {
        const int next = heir_[g];
        heir_[g] = last;
        g = next;
      }
    }
    return {std::move(mesh_), std::move(heir_)};
  }

 private:
  // Those that stand for a part of a vertex only.
  static std::vector<char> FixedVertices(const FannedSurface& surface) {
    int source_count = 0;
    for (int s : surface.source_vertex) source_count = std::max(source_count, s + 1);
    std::vector<int> fans(source_count, 0);
    for (int s : surface.source_vertex) ++fans[s];
    std::vector<char> fixed;
    for (int s : surface.source_vertex) fixed.push_back(fans[s] > 1);
    return fixed;
  }

  void PollNowAndThen(int step) const {
    constexpr int kPollEvery = 8192;
    if (poll_ && step % kPollEvery == 0) poll_();
  }

  // Costs are relative: to unit area, with the origin inside.
  void Normalize() {
    positions_ = surface_.positions;
    Vector3d low = Vector3d::Constant(kNever), high = -low;
    for (const Vector3d& p : positions_) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    double area = 0;
    for (int f = 0; f < static_cast<int>(ids_.size()); ++f) area += NormalOf(f).norm() / 2;
    const double scale = area > 0 ? 1 / std::sqrt(area) : 1;
    for (Vector3d& p : positions_) p = (p - (low + high) / 2) * scale;
  }

  void CountFaces() {
    faces_.assign(ChartCount(ids_) + 1, 0);
    std::vector<double> area(faces_.size(), 0);
    for (int f = 0; f < static_cast<int>(ids_.size()); ++f) {
      ++faces_[ids_[f] + 1];
      area[ids_[f] + 1] += NormalOf(f).norm() / 2;
    }
    int charts = 0;
    for (int count : faces_) {
      least_faces_.push_back(std::min(count, kLeastFaces));
      charts += count > 0;
    }
    for (double a : area) chart_weight_.push_back(1 / std::max(a * charts, kSmallestChart));
  }

  Vector3d NormalOf(int f) const {
    const Vector3d &a = positions_[mesh_.Vertex(3 * f)], &b = positions_[mesh_.Vertex(3 * f + 1)],
                   &c = positions_[mesh_.Vertex(3 * f + 2)];
    return (b - a).cross(c - a);
  }

  void SumQuadrics() {
    quadric_.resize(positions_.size());
    for (int f = 0; f < static_cast<int>(ids_.size()); ++f) {
      const Vector3d normal = NormalOf(f);
      const double norm = normal.norm();
      if (!(norm > 0)) continue;
      Quadric plane;
      plane.AddPlane(normal / norm, positions_[mesh_.Vertex(3 * f)], norm / 2 * chart_weight_[ids_[f] + 1]);
      for (int h = 3 * f; h < 3 * f + 3; ++h) quadric_[mesh_.Vertex(h)] += plane;
    }
    for (int h = 0; h < 3 * static_cast<int>(ids_.size()); ++h) {
      if (!lines_.IsBorder(h)) continue;
      const int a = mesh_.Vertex(h), b = mesh_.Vertex(Next(h));
      const Vector3d along = positions_[b] - positions_[a];
      const double squared = along.squaredNorm();
      if (!(squared > 0)) continue;
      Quadric line;
      line.AddLine(along / std::sqrt(squared), positions_[a],
                   kBorderWeight * squared * chart_weight_[ids_[h / 3] + 1]);
      quadric_[a] += line;
      quadric_[b] += line;
    }
  }

  // A lower bound of the cost, without regard to the faces' shapes.
  double Bound(int u, int v) const {
    const Vector3d& p = positions_[v];
    const double even = kEvenWeight * quadric_[u].PlaneWeight() * (positions_[u] - p).squaredNorm();
    return quadric_[u].At(p) + quadric_[v].At(p) + even;
  }

  double LeastBound(int u) {
    if (lines_.IsCorner(u)) return kNever;
    mesh_.Spokes(u, spokes_);
    double least = kNever;
    for (const Spoke& e : spokes_) least = std::min(least, Bound(u, e.vertex));
    return least;
  }

  void Push(int u, double key) {
    if (!(key < kNever)) return;
    key_[u] = key;
    queue_.push({key, u});
  }

  // The cheapest move of u that is allowed, and what it costs.
  double BestCollapse(int u, Spoke& best) {
    mesh_.Spokes(u, spokes_);
    ShapesAround(u);
    double least = kNever;
    for (const Spoke& e : spokes_) {
      const double bound = Bound(u, e.vertex);
      if (bound >= least || !lines_.MayCollapse(u, e) || !ChartsKeepEnough(e.half_edge)) continue;
      const double factor = ShapeFactor(e.vertex);
      if (!(factor < kNever)) continue;
      const double cost = bound * factor;
      if (cost >= least || !mesh_.MayCollapse(u, e) || TooManySpokes(e.vertex)) continue;
      least = cost;
      best = e;
    }
    return least;
  }

  bool ChartsKeepEnough(int half_edge) const {
    const int o = mesh_.Opposite(half_edge);
    const int a = ids_[half_edge / 3] + 1, b = o < 0 ? -1 : ids_[o / 3] + 1;
    if (a == b) return faces_[a] - 2 >= least_faces_[a];
    return faces_[a] > least_faces_[a] && (b < 0 || faces_[b] > least_faces_[b]);
  }

  // Large fans are slow, and slivers.
  bool TooManySpokes(int v) {
    mesh_.Outgoing(v, ring_v_);
    const int before = static_cast<int>(ring_v_.size());
    return before + static_cast<int>(ring_.size()) - 4 > std::max(kMostSpokes, before);
  }

  // The faces around u as they are.
  void ShapesAround(int u) {
    mesh_.Outgoing(u, ring_);
    ring_shapes_.clear();
    worst_around_ = 1;
    for (int h : ring_) {
      ring_shapes_.push_back(
          ShapeOf(positions_[u], positions_[mesh_.Vertex(Next(h))], positions_[mesh_.Vertex(Previous(h))]));
      worst_around_ = std::min(worst_around_, ring_shapes_.back().quality);
    }
  }

  // 1 when all the faces that would move are equilateral, infinite when one is turned over or becomes a
  // sliver.
  double ShapeFactor(int v) const {
    double worst = 1;
    for (size_t k = 0; k < ring_.size(); ++k) {
      const int b = mesh_.Vertex(Next(ring_[k])), c = mesh_.Vertex(Previous(ring_[k]));
      if (b == v || c == v) continue;
      const Shape& before = ring_shapes_[k];
      const Shape after = ShapeOf(positions_[v], positions_[b], positions_[c]);
      worst = std::min(worst, after.quality);
      if (before.quality < kNoArea) continue;
      const double cosine = before.normal.dot(after.normal) / (before.normal.norm() * after.normal.norm());
      if (!(cosine > kLeastCosine)) return kNever;  // not a number when the face loses its area
    }
    if (worst < kLeastQuality && worst < worst_around_) return kNever;
    return 1 + kShapeWeight * (1 / std::max(worst, kNoArea) - 1);
  }

  void Collapse(int u, const Spoke& e) {
    const int v = e.vertex, o = mesh_.Opposite(e.half_edge);
    --faces_[ids_[e.half_edge / 3] + 1];
    if (o >= 0) --faces_[ids_[o / 3] + 1];
    if (history_) Record(u);
    Inherit(e.half_edge);
    if (o >= 0) Inherit(o);
    mesh_.Collapse(u, e);
    lines_.Collapsed(u);
    quadric_[v] += quadric_[u];
    Push(v, LeastBound(v));
    mesh_.Spokes(v, spokes_);
    for (const Spoke& s : spokes_) {
      if (lines_.IsCorner(s.vertex)) continue;
      const double bound = Bound(s.vertex, v);
      if (bound < key_[s.vertex]) Push(s.vertex, bound);
    }
  }

  // The face at a half-edge that is to be collapsed: of the two that it leaves a side to, one of its chart,
  // if there is one.
  void Inherit(int half_edge) {
    const int f = half_edge / 3, a = mesh_.Opposite(Next(half_edge)), b = mesh_.Opposite(Previous(half_edge));
    const bool first = a >= 0 && (b < 0 || ids_[a / 3] == ids_[f] || ids_[b / 3] != ids_[f]);
    heir_[f] = first ? a / 3 : b / 3;
  }

  // ring_ is that of u, from BestCollapse.
  void Record(int u) {
    const int begin = static_cast<int>(history_->rings.size());
    for (int h : ring_) history_->rings.push_back(mesh_.Vertex(Next(h)));
    const int last = Previous(ring_.back());
    const bool closed = mesh_.Opposite(last) >= 0;
    if (!closed) history_->rings.push_back(mesh_.Vertex(last));
    history_->steps.push_back({u, begin, closed});
  }

  const FannedSurface& surface_;
  const ChartIds& ids_;
  const std::function<void()>& poll_;
  CollapseHistory* history_ = nullptr;
  std::vector<int> heir_;
  std::vector<char> fixed_;
  CollapsingMesh mesh_;
  BorderLines lines_;
  std::vector<Vector3d> positions_;
  std::vector<Quadric> quadric_;
  // Per chart, the first for unassigned faces.
  std::vector<int> faces_, least_faces_;
  std::vector<double> chart_weight_;
  // Vertices by the cost of their cheapest move, or less; an entry is out of date when it differs from key_.
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
  std::vector<double> key_;
  std::vector<Spoke> spokes_;
  std::vector<int> ring_, ring_v_;
  std::vector<Shape> ring_shapes_;  // per face of ring_
  double worst_around_ = 1;         // quality of these
};

}  // namespace

CoarsenedSurface Coarsened(const FannedSurface& surface, const ChartIds& ids, int target_faces,
                           CollapseHistory* history, const std::function<void()>& poll) {
  Coarsener coarsener(surface, ids, poll);
  coarsener.Run(target_faces, history);
  return coarsener.Take();
}

}  // namespace dcharts
