// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/coarsen.h"

#include <vcg/complex/allocate.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "surface/coarsen_borders.h"
#include "surface/coarsen_connectivity.h"
#include "surface/coarsen_quadric.h"

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
  Coarsener(const FannedSurface& surface, const ChartIds& ids)
      : surface_(surface),
        ids_(ids),
        fixed_(FixedVertices(surface)),
        mesh_(surface.vertex, surface.opposite, static_cast<int>(surface.positions.size())),
        lines_(mesh_, ids_, fixed_) {}

  void Run(int target_faces) {
    Normalize();
    CountFaces();
    SumQuadrics();
    key_.assign(positions_.size(), kNever);
    for (int v = 0; v < static_cast<int>(positions_.size()); ++v) Push(v, LeastBound(v));
    while (!queue_.empty() && mesh_.FaceCount() > target_faces) {
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

  CoarseSurface Take() const {
    CoarseSurface coarse;
    coarse.mesh = std::make_unique<SurfaceMesh>();
    SurfaceMesh& mesh = *coarse.mesh;
    const int fan_count = static_cast<int>(surface_.positions.size());
    std::vector<int> new_vertex(fan_count, -1), new_face(ids_.size(), -1);
    std::vector<int> order;
    for (int v = 0; v < fan_count; ++v)
      if (mesh_.VertexLives(v)) order.push_back(v);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return surface_.source_vertex[a] < surface_.source_vertex[b]; });
    vcg::tri::Allocator<SurfaceMesh>::AddVertices(mesh, order.size());
    for (int v : order) {
      const int n = new_vertex[v] = static_cast<int>(coarse.source_vertex.size());
      coarse.source_vertex.push_back(surface_.source_vertex[v]);
      const Vector3d& p = surface_.positions[v];
      mesh.vert[n].P() = vcg::Point3d(p[0], p[1], p[2]);
    }
    for (int f = 0; f < static_cast<int>(ids_.size()); ++f)
      if (mesh_.FaceLives(f)) {
        new_face[f] = static_cast<int>(coarse.ids.size());
        coarse.ids.push_back(ids_[f]);
      }
    vcg::tri::Allocator<SurfaceMesh>::AddFaces(mesh, coarse.ids.size());
    // The topology is known here. Found again from the vertices it might close slits.
    for (int h = 0; h < 3 * static_cast<int>(ids_.size()); ++h) {
      if (new_face[h / 3] < 0) continue;
      SurfaceFace& face = mesh.face[new_face[h / 3]];
      const int i = h % 3, o = mesh_.Opposite(h);
      face.V(i) = &mesh.vert[new_vertex[mesh_.Vertex(h)]];
      face.FFp(i) = o < 0 ? &face : &mesh.face[new_face[o / 3]];
      face.FFi(i) = static_cast<char>(o < 0 ? i : o % 3);
    }
    return coarse;
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

  const FannedSurface& surface_;
  const ChartIds& ids_;
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

CoarseSurface CoarsenFanned(const FannedSurface& surface, const ChartIds& ids, int target_faces) {
  Coarsener coarsener(surface, ids);
  coarsener.Run(target_faces);
  return coarsener.Take();
}

}  // namespace dcharts
