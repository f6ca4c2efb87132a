// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/packing_compact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "planar/outline_loops.h"

namespace dcharts {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kSide = 1024;  // of the square, in the units used here

double Cross(const Vec& a, const Vec& b) { return a.x() * b.y() - a.y() * b.x(); }
double Largest(const Vec& v) { return std::max(std::abs(v.x()), std::abs(v.y())); }
double Sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// To a grid, so that rounding in the input, which its scale decides, makes no difference.
double Rounded(double x) { return std::ldexp(std::round(std::ldexp(x, 20)), -20); }

// Distances here are the larger of those along x and y: charts are apart when so many texels are free.
// The point of segment a, b nearest to p: its place, 0..1.
double NearestOnSegment(const Vec& p, const Vec& a, const Vec& b) {
  const Vec e = b - a, n(e.y(), -e.x());
  const double length = e.squaredNorm();
  if (!(length > 0)) return 0;
  const double reach = (p - a).dot(n) / (std::abs(n.x()) + std::abs(n.y()));
  const Vec touched = p - reach * Vec(Sign(n.x()), Sign(n.y()));
  return std::clamp((touched - a).dot(e) / length, 0.0, 1.0);
}

struct Box {
  Vec low = Vec::Constant(std::numeric_limits<double>::infinity()), high = -low;
  void Add(const Vec& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double DistanceTo(const Box& o) const {
    return std::max((o.low - high).maxCoeff(), (low - o.high).maxCoeff());
  }
  double DistanceTo(const Vec& p) const { return std::max((p - high).maxCoeff(), (low - p).maxCoeff()); }
};

// Closed outlines, counterclockwise, holes clockwise; about the chart's middle, at the scale of the start.
struct Shape {
  std::vector<Vec> corners;
  std::vector<int> next, before;  // along the outline
  double radius = 0;
};

struct Pose {
  Vec middle;
  double angle = 0;
};

Shape MakeShape(const std::vector<std::vector<Vec>>& loops) {
  Shape shape;
  for (const std::vector<Vec>& loop : loops) {
    const int base = static_cast<int>(shape.corners.size()), size = static_cast<int>(loop.size());
    for (int k = 0; k < size; ++k) {
      shape.corners.push_back(loop[k]);
      shape.next.push_back(base + (k + 1) % size);
      shape.before.push_back(base + (k + size - 1) % size);
      shape.radius = std::max(shape.radius, loop[k].norm());
    }
  }
  return shape;
}

// A shape in its place.
struct PlacedShape {
  std::vector<Vec> corners;
  Box box;
};

PlacedShape Place(const Shape& shape, const Pose& pose, double scale) {
  PlacedShape placed;
  const double c = scale * std::cos(pose.angle), s = scale * std::sin(pose.angle);
  placed.corners.reserve(shape.corners.size());
  for (const Vec& q : shape.corners) {
    placed.corners.emplace_back(pose.middle.x() + c * q.x() - s * q.y(),
                                pose.middle.y() + s * q.x() + c * q.y());
    placed.box.Add(placed.corners.back());
  }
  return placed;
}

bool IsInside(const Shape& shape, const PlacedShape& placed, const Vec& p) {
  bool inside = false;
  for (size_t k = 0; k < placed.corners.size(); ++k) {
    const Vec &a = placed.corners[k], &b = placed.corners[shape.next[k]];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

// The least distance of two charts, or `most` when it is that much; 0 when they overlap.
double Distance(const Shape& shape_a, const PlacedShape& a, const Shape& shape_b, const PlacedShape& b,
                double most) {
  if (a.box.DistanceTo(b.box) >= most) return most;
  std::vector<size_t> near_a;
  for (size_t i = 0; i < a.corners.size(); ++i) {
    Box edge;
    edge.Add(a.corners[i]);
    edge.Add(a.corners[shape_a.next[i]]);
    if (edge.DistanceTo(b.box) < most) near_a.push_back(i);
  }
  double least = most;
  for (size_t j = 0; j < b.corners.size(); ++j) {
    const Vec &c = b.corners[j], &d = b.corners[shape_b.next[j]];
    Box edge;
    edge.Add(c);
    edge.Add(d);
    if (edge.DistanceTo(a.box) >= least) continue;
    for (const size_t i : near_a) {
      const Vec &p = a.corners[i], &q = a.corners[shape_a.next[i]];
      Box other;
      other.Add(p);
      other.Add(q);
      if (edge.DistanceTo(other) >= least) continue;
      if (Cross(d - c, p - c) * Cross(d - c, q - c) <= 0 && Cross(q - p, c - p) * Cross(q - p, d - p) <= 0)
        return 0;
      const auto from = [](const Vec& x, const Vec& u, const Vec& v) {
        return Largest(x - u - NearestOnSegment(x, u, v) * (v - u));
      };
      least = std::min({least, from(p, c, d), from(q, c, d), from(c, p, q), from(d, p, q)});
    }
  }
  if (IsInside(shape_a, a, b.corners[0]) || IsInside(shape_b, b, a.corners[0])) return 0;
  return least;
}

// Pairs of charts whose boxes are at most `reach` apart, in order.
std::vector<std::pair<int, int>> NearPairs(const std::vector<PlacedShape>& placed, double reach) {
  std::vector<int> order(placed.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::make_pair(placed[a].box.low.x(), a) < std::make_pair(placed[b].box.low.x(), b);
  });
  std::vector<std::pair<int, int>> pairs;
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t j = i + 1; j < order.size(); ++j) {
      const Box &a = placed[order[i]].box, &b = placed[order[j]].box;
      if (b.low.x() - a.high.x() > reach) break;
      if (a.DistanceTo(b) <= reach) pairs.emplace_back(std::minmax(order[i], order[j]));
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// One inequality: gap + normal . (motion of charts a and b at the point) >= 0.
struct Contact {
  int a, b;  // b: -1 for a side of the square
  double gap;
  Vec normal;               // of a's motion; b's counts against it
  double lever_a, lever_b;  // of the normal about the middles
  double stiffness, pushed;
};

class Compactor {
 public:
  Compactor(std::vector<Shape> shapes, std::vector<Pose> poses, double padding, const CompactOptions& options,
            const std::function<void()>& poll)
      : shapes_(std::move(shapes)),
        count_(static_cast<int>(shapes_.size())),
        // Contacts end as violated as kTolerance allows; the exact test asks for less than that.
        padding_(padding + kTolerance),
        rotate_(options.rotate),
        steps_left_(options.most_steps),
        poll_(poll),
        poses_(std::move(poses)),
        placed_(count_),
        motion_(count_) {}

  // Grows the charts from `scale` (1: as they came) as far as it goes; 0 when they can't be freed of overlap.
  double Grow(double scale) {
    double found = 0, step = kFirstStep;
    std::vector<Pose> best;
    while (steps_left_ > 0 && step >= kLeastStep) {
      if (Relax(scale)) {
        found = scale;
        best = poses_;
        scale *= 1 + step;
      } else if (found == 0) {
        if (scale < kLeastScale) return 0;
        scale *= 1 - kFirstShrink;
      } else {
        step /= 2;
        poses_ = best;
        is_listed_ = false;
        scale = found * (1 + step);
      }
    }
    if (found > 0) poses_ = best;
    return found;
  }

  // The place `at`, 0..1, of an edge is the nearest to a point.
  struct NearEdge {
    int edge;
    double at, distance;
  };

  static Vec Outward(const Shape& shape, const std::vector<Vec>& corners, int edge) {
    const Vec e = corners[shape.next[edge]] - corners[edge];
    return Vec(e.y(), -e.x()).stableNormalized();
  }

  // Whether p is on the outer side of the outline there.
  static bool IsOutside(const Vec& p, const Shape& shape, const std::vector<Vec>& corners,
                        const NearEdge& edge) {
    if (edge.at > 0 && edge.at < 1)
      return (p - corners[edge.edge]).dot(Outward(shape, corners, edge.edge)) > 0;
    const int corner = edge.at > 0 ? shape.next[edge.edge] : edge.edge;
    const Vec &v = corners[corner], to = corners[shape.next[corner]] - v,
              from = v - corners[shape.before[corner]];
    const bool beyond_to = Cross(to, p - v) < 0, beyond_from = Cross(from, p - v) < 0;
    return Cross(from, to) > 0 ? beyond_to || beyond_from : beyond_to && beyond_from;
  }

  // Moves charts until they are clear of each other and within the square.
  bool Relax(double scale) {
    --steps_left_;
    double before = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kRelaxSteps; ++step) {
      if (poll_) poll_();
      for (int k = 0; k < count_; ++k) placed_[k] = Place(shapes_[k], poses_[k], scale);
      const double worst = FindContacts(scale);
      if (worst <= kTolerance) return true;
      if (--steps_left_ <= 0) return false;
      // Hardly any progress in the last steps: jammed.
      if (step % 4 == 3) {
        if (worst > 0.7 * before) return false;
        before = worst;
      }
      SolveContacts(scale);
    }
    return false;
  }

  const std::vector<Pose>& Poses() const { return poses_; }

 private:
  static constexpr double kTolerance = 0.02, kReach = 2.5, kMostMotion = 1.5, kListed = 3, kFirstStep = 0.01,
                          kLeastStep = 0.0002, kFirstShrink = 0.01, kLeastScale = 0.8;
  static constexpr int kRelaxSteps = 12, kSweeps = 20;

  // Corner `corner` of chart a is near edges first..last-1 of edges_, which are chart b's.
  struct NearEdges {
    int a, corner, b, first, last;
  };

  // Lists what may touch before charts have moved by kListed in all.
  void ListNearEdges(double scale) {
    near_.clear();
    edges_.clear();
    const double reach = padding_ + kReach + kListed;
    for (const auto& [a, b] : NearPairs(placed_, reach)) {
      ListNearEdges(a, b, reach);
      ListNearEdges(b, a, reach);
    }
    moved_ = 0;
    listed_scale_ = scale;
    is_listed_ = true;
  }

  // Corners of chart a near edges of chart b.
  void ListNearEdges(int a, int b, double reach) {
    close_.clear();
    for (size_t j = 0; j < shapes_[b].corners.size(); ++j) {
      Box edge;
      edge.Add(placed_[b].corners[j]);
      edge.Add(placed_[b].corners[shapes_[b].next[j]]);
      if (edge.DistanceTo(placed_[a].box) <= reach) close_.push_back({edge, static_cast<int>(j)});
    }
    SortIntoStrips(reach);
    for (size_t i = 0; i < shapes_[a].corners.size(); ++i) {
      const Vec& p = placed_[a].corners[i];
      if (placed_[b].box.DistanceTo(p) > reach) continue;
      const int first = static_cast<int>(edges_.size());
      for (const int k : strips_[StripOf(p[strip_axis_])])
        if (close_[k].first.DistanceTo(p) <= reach) edges_.push_back(close_[k].second);
      const int last = static_cast<int>(edges_.size());
      if (first < last) near_.push_back({a, static_cast<int>(i), b, first, last});
    }
  }

  // Each of close_ into the strips across the longer side of their box that it is within reach of.
  void SortIntoStrips(double reach) {
    constexpr double kMostStrips = 256;
    for (std::vector<int>& strip : strips_) strip.clear();
    Box box;
    for (const auto& close : close_) {
      box.Add(close.first.low);
      box.Add(close.first.high);
    }
    const Vec size = close_.empty() ? Vec(0, 0) : Vec(box.high - box.low);
    strip_axis_ = size.x() >= size.y() ? 0 : 1;
    strip_begin_ = close_.empty() ? 0 : box.low[strip_axis_];
    strip_width_ = std::max(reach, size[strip_axis_] / kMostStrips);
    strips_.resize(std::max(strips_.size(), static_cast<size_t>(size[strip_axis_] / strip_width_) + 1));
    strip_count_ = static_cast<int>(size[strip_axis_] / strip_width_) + 1;
    for (int k = 0; k < static_cast<int>(close_.size()); ++k)
      for (int strip = StripOf(close_[k].first.low[strip_axis_] - reach);
           strip <= StripOf(close_[k].first.high[strip_axis_] + reach); ++strip)
        strips_[strip].push_back(k);
  }
  int StripOf(double x) const {
    return std::clamp(static_cast<int>(std::floor((x - strip_begin_) / strip_width_)), 0, strip_count_ - 1);
  }

  // Returns by how much the worst contact is violated.
  double FindContacts(double scale) {
    double largest = 0;
    for (const Shape& s : shapes_) largest = std::max(largest, s.radius);
    if (!is_listed_ || 2 * (moved_ + largest * std::abs(scale - listed_scale_)) > kListed)
      ListNearEdges(scale);
    contacts_.clear();
    double worst = 0;
    for (const NearEdges& n : near_) {
      const Vec& p = placed_[n.a].corners[n.corner];
      const Shape& shape = shapes_[n.b];
      const std::vector<Vec>& corners = placed_[n.b].corners;
      found_.clear();
      double least = padding_ + kReach;
      size_t nearest = 0;
      for (int e = n.first; e < n.last; ++e) {
        const int j = edges_[e];
        const Vec &u = corners[j], &v = corners[shape.next[j]];
        const double t = NearestOnSegment(p, u, v), d = Largest(p - u - t * (v - u));
        if (d > padding_ + kReach) continue;
        if (d < least) {
          least = d;
          nearest = found_.size();
        }
        found_.push_back({j, t, d});
      }
      if (found_.empty()) continue;
      const bool is_outside = IsOutside(p, shape, corners, found_[nearest]);
      worst = std::max(worst, padding_ - (is_outside ? least : -least));
      for (size_t k = 0; k < found_.size(); ++k) {
        const NearEdge& edge = found_[k];
        // In a notch, all its walls count. A corner counts once, with the edge that begins there.
        if (k != nearest && (!is_outside || edge.at == 1 || !IsOutside(p, shape, corners, edge))) continue;
        const Vec &u = corners[edge.edge], &v = corners[shape.next[edge.edge]];
        Vec normal = p - u - edge.at * (v - u);
        if (edge.at > 0 && edge.at < 1) {
          normal = Outward(shape, corners, edge.edge);
          normal /= std::abs(normal.x()) + std::abs(normal.y());
        } else {
          normal = std::abs(normal.x()) > std::abs(normal.y()) ? Vec(Sign(normal.x()), 0)
                                                               : Vec(0, Sign(normal.y()));
          if (!is_outside) normal = -normal;
        }
        Add(n.a, n.b, p, (is_outside ? edge.distance : -edge.distance) - padding_, normal, scale);
      }
    }
    for (int k = 0; k < count_; ++k) {
      const double margin = padding_ / 2;
      const Box& box = placed_[k].box;
      const double inside = std::min(box.low.minCoeff(), kSide - box.high.maxCoeff()) - margin;
      worst = std::max(worst, -inside);
      if (inside > kReach) continue;
      for (const Vec& p : placed_[k].corners)
        for (int d : {0, 1}) {
          const Vec axis = d == 0 ? Vec(1, 0) : Vec(0, 1);
          if (p[d] - margin < kReach) Add(k, -1, p, p[d] - margin, axis, scale);
          if (kSide - p[d] - margin < kReach) Add(k, -1, p, kSide - p[d] - margin, -axis, scale);
        }
    }
    return worst;
  }

  // Heavy charts move less.
  double Lightness(int k) const { return k < 0 ? 0 : 1 / (shapes_[k].radius + 1e-9); }
  double Slackness(int k, double scale) const {
    if (k < 0 || !rotate_) return 0;
    const double radius = shapes_[k].radius * scale + 1e-9;
    return 2 * Lightness(k) / (radius * radius);
  }

  void Add(int a, int b, const Vec& p, double gap, const Vec& normal, double scale) {
    Contact c{a, b, gap, normal, Cross(p - poses_[a].middle, normal), 0, 0, 0};
    if (b >= 0) c.lever_b = Cross(p - poses_[b].middle, normal);
    c.stiffness = normal.squaredNorm() * (Lightness(a) + Lightness(b)) +
                  c.lever_a * c.lever_a * Slackness(a, scale) + c.lever_b * c.lever_b * Slackness(b, scale);
    contacts_.push_back(c);
  }

  // The least motion that meets all contacts, nearly; then makes it.
  void SolveContacts(double scale) {
    for (Motion& m : motion_) m = {};
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      for (Contact& c : contacts_) {
        Motion& of_a = motion_[c.a];
        double gap = c.gap + c.normal.dot(of_a.shift) + c.lever_a * of_a.turn;
        if (c.b >= 0) gap -= c.normal.dot(motion_[c.b].shift) + c.lever_b * motion_[c.b].turn;
        const double push = std::max(-c.pushed, -gap / c.stiffness);
        if (push == 0) continue;
        c.pushed += push;
        of_a.shift += push * Lightness(c.a) * c.normal;
        of_a.turn += push * Slackness(c.a, scale) * c.lever_a;
        if (c.b < 0) continue;
        motion_[c.b].shift -= push * Lightness(c.b) * c.normal;
        motion_[c.b].turn -= push * Slackness(c.b, scale) * c.lever_b;
      }
    double most = 0;
    for (int k = 0; k < count_; ++k) {
      const double size = motion_[k].shift.norm() + std::abs(motion_[k].turn) * shapes_[k].radius * scale;
      const double share = size > kMostMotion ? kMostMotion / size : 1;
      poses_[k].middle += share * motion_[k].shift;
      poses_[k].angle += share * motion_[k].turn;
      most = std::max(most, share * size);
    }
    moved_ += most;
  }

  struct Motion {
    Vec shift = Vec::Zero();
    double turn = 0;
  };

  const std::vector<Shape> shapes_;
  const int count_;
  const double padding_;
  const bool rotate_;
  int steps_left_;
  const std::function<void()>& poll_;
  std::vector<Pose> poses_;
  std::vector<PlacedShape> placed_;
  std::vector<Motion> motion_;
  std::vector<NearEdges> near_;
  std::vector<int> edges_;
  std::vector<std::pair<Box, int>> close_;
  std::vector<std::vector<int>> strips_;  // of close_
  int strip_axis_ = 0, strip_count_ = 1;
  double strip_begin_ = 0, strip_width_ = 1;
  std::vector<NearEdge> found_;
  std::vector<Contact> contacts_;
  double moved_ = 0, listed_scale_ = 0;
  bool is_listed_ = false;
};

// Whether all charts lie within the square and apart.
bool IsSound(const std::vector<Shape>& shapes, const std::vector<Pose>& poses, double scale, double padding) {
  std::vector<PlacedShape> placed;
  for (size_t k = 0; k < shapes.size(); ++k) {
    placed.push_back(Place(shapes[k], poses[k], scale));
    const Box& box = placed.back().box;
    if (box.low.minCoeff() < padding / 2 || box.high.maxCoeff() > kSide - padding / 2) return false;
  }
  for (const auto& [i, j] : NearPairs(placed, padding))
    if (Distance(shapes[i], placed[i], shapes[j], placed[j], padding) < padding) return false;
  return true;
}

}  // namespace

bool Compact(const std::vector<Points2>& outlines, const CompactOptions& options, double least_scale,
             const std::function<void()>& poll, Packing* packing) {
  constexpr double kStart = 0.97;  // frees the charts of overlap as a rule
  constexpr double kSimpler = 0.02, kMostSimpler = 1;
  constexpr size_t kManyCorners = 8000, kManyPerChart = 30;
  const double padding = options.padding * kSide;
  std::vector<std::vector<std::vector<Vec>>> all_loops;
  std::vector<Shape> full, simple;
  std::vector<Pose> poses;
  std::vector<Vec> middles;
  const double units = packing->scale * kSide;
  for (size_t k = 0; k < outlines.size(); ++k) {
    const Points2& outline = outlines[k];
    const Vec low = outline.colwise().minCoeff(), high = outline.colwise().maxCoeff(),
              middle = (low + high) / 2;
    std::vector<std::vector<Vec>> loops;
    if (!OutlineLoops(outline, &loops)) return false;
    for (auto& loop : loops)
      for (Vec& p : loop) p = (units * (p - middle)).unaryExpr(&Rounded);
    full.push_back(MakeShape(loops));
    all_loops.push_back(std::move(loops));
    middles.push_back(middle);
    const Placement& at = packing->placements[k];
    const Vec turned = Eigen::Rotation2Dd(at.angle) * middle;
    poses.push_back({(kSide * (packing->scale * turned + at.offset)).unaryExpr(&Rounded), 0});
    poses.back().angle = options.rotate ? Rounded(at.angle) : at.angle;
  }
  // Time goes with the corners: where there are very many, they are simplified more, and padded as much.
  double simpler = kSimpler;
  for (;; simpler *= 2) {
    simple.clear();
    size_t corners = 0;
    for (const auto& loops : all_loops) {
      std::vector<std::vector<Vec>> fewer;
      for (const auto& loop : loops) fewer.push_back(Simplified(loop, simpler));
      simple.push_back(MakeShape(fewer));
      corners += simple.back().corners.size();
    }
    if (corners <= std::max(kManyCorners, kManyPerChart * outlines.size()) || 2 * simpler > kMostSimpler)
      break;
  }
  Compactor compactor(std::move(simple), std::move(poses), padding + 2 * simpler, options, poll);
  double scale = compactor.Grow(kStart);
  if (scale * packing->scale <= least_scale) return false;
  // Sound as a rule, but the outlines that pushed each other were a little simpler than those that count.
  constexpr int kMostTests = 4;
  constexpr double kStep = 0.001;
  for (int test = 0; !IsSound(full, compactor.Poses(), scale, padding); ++test) {
    scale *= 1 - kStep;
    if (test == kMostTests || scale * packing->scale <= least_scale || !compactor.Relax(scale)) return false;
  }
  packing->scale *= scale;
  for (size_t k = 0; k < outlines.size(); ++k) {
    const Pose& pose = compactor.Poses()[k];
    const double angle = options.rotate ? pose.angle : packing->placements[k].angle;
    packing->placements[k] = {
        angle, pose.middle / kSide - packing->scale * (Eigen::Rotation2Dd(angle) * middles[k])};
  }
  return true;
}

}  // namespace dcharts
