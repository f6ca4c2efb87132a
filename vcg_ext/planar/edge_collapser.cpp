// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/edge_collapser.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "common/half_edge.h"

namespace dcharts {
namespace {

// Chosen so that on scanned models the stretch of flattened charts, and of pairs of them, comes out as on the
// fine mesh.
constexpr int kLeastFaces = 30;         // that a chart keeps
constexpr double kEvenWeight = 5e-3;    // of the length moved, against the distance to the surface
constexpr double kShapeWeight = 4;      // of thin faces
constexpr double kLeastQuality = 0.05;  // of a face that was better before
constexpr double kLeastCosine = 0.7;    // between a face's normals before and after a step
constexpr int kMostSpokes = 14;         // of a vertex that had fewer before
constexpr double kNoArea = 1e-9;        // quality of a face that is a line

constexpr int kPollEvery = 1024;  // steps

}  // namespace

EdgeCollapser::EdgeCollapser(CollapseTask task, bool keeps_history, const std::function<void()>& poll)
    : task_(std::move(task)),
      mesh_(std::move(task_.vertex), std::move(task_.opposite), static_cast<int>(task_.positions.size())),
      lines_(mesh_, task_.ids, task_.freedom),
      keeps_history_(keeps_history),
      heir_(task_.ids.size()),
      key_(task_.positions.size(), kNever) {
  std::iota(heir_.begin(), heir_.end(), 0);
  CountFaces();
  std::vector<double> costs;
  for (int v = 0; v < static_cast<int>(task_.positions.size()); ++v) {
    if (poll && v % kPollEvery == 0) poll();
    Push(v, LeastBound(v));
    if (key_[v] < kNever) costs.push_back(key_[v]);
  }
  if (costs.empty()) return;
  const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
  std::nth_element(costs.begin(), middle, costs.end());
  median_cost_ = *middle;
}

void EdgeCollapser::Run(int target_faces, double most_cost, const std::function<void()>& poll) {
  int steps = 0;
  while (!queue_.empty() && mesh_.FaceCount() > target_faces && !(queue_.top().first > most_cost)) {
    if (poll && steps++ % kPollEvery == 0) poll();
    const auto [key, u] = queue_.top();
    queue_.pop();
    if (key != key_[u] || !mesh_.VertexLives(u)) continue;
    Spoke best{-1, -1};
    const double cost = BestCollapse(u, best);
    key_[u] = kNever;
    if (best.vertex < 0) continue;
    // The key was only a lower bound.
    if (cost > most_cost || (!queue_.empty() && cost > queue_.top().first))
      Push(u, cost);
    else
      Collapse(u, best);
  }
}

EdgeCollapser::Shape EdgeCollapser::ShapeOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                            const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  Shape shape;
  shape.normal = ab.cross(ac);
  shape.twice_area = shape.normal.norm();
  const double squares = ab.squaredNorm() + ac.squaredNorm() + (c - b).squaredNorm();
  constexpr double kTwoSqrt3 = 3.4641016151377546;
  shape.quality = squares > 0 ? kTwoSqrt3 * shape.twice_area / squares : 0;
  return shape;
}

void EdgeCollapser::CountFaces() {
  faces_.assign(ChartCount(task_.ids) + 1, 0);
  for (int id : task_.ids) ++faces_[id + 1];
  for (int count : faces_) least_faces_.push_back(std::min(count, kLeastFaces));
}

// A lower bound of the cost, without regard to the faces' shapes.
double EdgeCollapser::Bound(int u, int v) const {
  const Eigen::Vector3d& p = task_.positions[v];
  const double even = kEvenWeight * task_.quadrics[u].PlaneWeight() * (task_.positions[u] - p).squaredNorm();
  return task_.quadrics[u].At(p) + task_.quadrics[v].At(p) + even;
}

double EdgeCollapser::LeastBound(int u) {
  if (lines_.IsCorner(u)) return kNever;
  mesh_.Spokes(u, spokes_);
  double least = kNever;
  for (const Spoke& e : spokes_)
    if (task_.freedom[e.vertex] != kApart) least = std::min(least, Bound(u, e.vertex));
  return least;
}

void EdgeCollapser::Push(int u, double key) {
  if (!(key < kNever)) return;
  key_[u] = key;
  queue_.push({key, u});
}

// The cheapest move of u that is allowed, and what it costs.
double EdgeCollapser::BestCollapse(int u, Spoke& best) {
  mesh_.Spokes(u, spokes_);
  ShapesAround(u);
  double least = kNever;
  for (const Spoke& e : spokes_) {
    if (task_.freedom[e.vertex] == kApart) continue;
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

bool EdgeCollapser::ChartsKeepEnough(int half_edge) const {
  const int o = mesh_.Opposite(half_edge);
  const int a = task_.ids[half_edge / 3] + 1, b = o < 0 ? -1 : task_.ids[o / 3] + 1;
  if (a == b) return faces_[a] - 2 >= least_faces_[a];
  return faces_[a] > least_faces_[a] && (b < 0 || faces_[b] > least_faces_[b]);
}

// Large fans are slow, and slivers.
bool EdgeCollapser::TooManySpokes(int v) {
  mesh_.Outgoing(v, ring_v_);
  const int before = static_cast<int>(ring_v_.size());
  return before + static_cast<int>(ring_.size()) - 4 > std::max(kMostSpokes, before);
}

// The faces around u as they are.
void EdgeCollapser::ShapesAround(int u) {
  mesh_.Outgoing(u, ring_);
  ring_shapes_.clear();
  worst_around_ = 1;
  for (int h : ring_) {
    ring_shapes_.push_back(ShapeOf(task_.positions[u], task_.positions[mesh_.Vertex(Next(h))],
                                   task_.positions[mesh_.Vertex(Previous(h))]));
    worst_around_ = std::min(worst_around_, ring_shapes_.back().quality);
  }
}

// 1 when all the faces that would move are equilateral, infinite when one is turned over or becomes a
// sliver.
double EdgeCollapser::ShapeFactor(int v) const {
  double worst = 1;
  for (size_t k = 0; k < ring_.size(); ++k) {
    const int b = mesh_.Vertex(Next(ring_[k])), c = mesh_.Vertex(Previous(ring_[k]));
    if (b == v || c == v) continue;
    const Shape& before = ring_shapes_[k];
    const Shape after = ShapeOf(task_.positions[v], task_.positions[b], task_.positions[c]);
    worst = std::min(worst, after.quality);
    if (before.quality < kNoArea) continue;
    const double cosine = before.normal.dot(after.normal) / (before.twice_area * after.twice_area);
    if (!(cosine > kLeastCosine)) return kNever;  // not a number when the face loses its area
  }
  if (worst < kLeastQuality && worst < worst_around_) return kNever;
  return 1 + kShapeWeight * (1 / std::max(worst, kNoArea) - 1);
}

void EdgeCollapser::Collapse(int u, const Spoke& e) {
  const int v = e.vertex, o = mesh_.Opposite(e.half_edge);
  --faces_[task_.ids[e.half_edge / 3] + 1];
  if (o >= 0) --faces_[task_.ids[o / 3] + 1];
  if (keeps_history_) Record(u);
  Inherit(e.half_edge);
  if (o >= 0) Inherit(o);
  mesh_.Collapse(u, e);
  lines_.Collapsed(u);
  task_.quadrics[v] += task_.quadrics[u];
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
void EdgeCollapser::Inherit(int half_edge) {
  const int f = half_edge / 3, a = mesh_.Opposite(Next(half_edge)), b = mesh_.Opposite(Previous(half_edge));
  const bool first =
      a >= 0 && (b < 0 || task_.ids[a / 3] == task_.ids[f] || task_.ids[b / 3] != task_.ids[f]);
  heir_[f] = first ? a / 3 : b / 3;
}

// ring_ is that of u, from BestCollapse.
void EdgeCollapser::Record(int u) {
  const int begin = static_cast<int>(history_.rings.size());
  for (int h : ring_) history_.rings.push_back(mesh_.Vertex(Next(h)));
  const int last = Previous(ring_.back());
  const bool closed = mesh_.Opposite(last) >= 0;
  if (!closed) history_.rings.push_back(mesh_.Vertex(last));
  history_.steps.push_back({u, begin, closed});
}

}  // namespace dcharts
