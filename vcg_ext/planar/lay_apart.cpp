// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/lay_apart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "planar/boundary_loops.h"
#include "planar/distortion.h"
#include "planar/flatten_start.h"
#include "planar/map_from_coarser.h"
#include "planar/normalized_chart.h"
#include "planar/overlap.h"
#include "planar/plane_points.h"
#include "planar/rest_shapes.h"
#include "planar/stretch_descent.h"
#include "planar/trial_flatten.h"
#include "planar/vertex_block_system.h"
#include "planar/vertex_descent.h"
#include "planar/vertex_pull.h"

namespace dcharts {
namespace {

bool IsInside(const Complex& z, const Complex& a, const Complex& b, const Complex& c) {
  return Cross(b - a, z - a) > 0 && Cross(c - b, z - b) > 0 && Cross(a - c, z - c) > 0;
}

/// The rim of a map, and which of its points have to be drawn away from which of its edges.
class Contacts {
 public:
  Contacts(const Triangles& triangles, double gap) : triangles_(triangles), gap_(gap) {
    const std::vector<std::vector<int>> loops = BoundaryLoops(triangles);
    for (int l = 0; l < static_cast<int>(loops.size()); ++l) {
      const int first = static_cast<int>(edges_.size()), count = static_cast<int>(loops[l].size());
      for (int i = 0; i < count; ++i) edges_.push_back({loops[l][i], loops[l][(i + 1) % count], l});
      loops_.push_back({first, count});
    }
    edge_from_.assign(static_cast<size_t>(triangles.maxCoeff()) + 1, -1);
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) edge_from_[edges_[e].a] = e;
  }

  // Finds points that are inside a triangle which overlaps one of theirs, or beyond an edge that crosses one
  // of theirs.
  void Find(const std::vector<std::pair<int, int>>& overlapping, const PlanePoints& uv) {
    inside_.clear();
    for (const auto& [i, j] : overlapping)
      for (const auto& [of, in] : {std::pair{i, j}, std::pair{j, i}})
        for (int k = 0; k < 3; ++k) {
          const int v = triangles_(of, k);
          if (edge_from_[v] < 0) continue;
          if (IsInside(uv[v], uv[triangles_(in, 0)], uv[triangles_(in, 1)], uv[triangles_(in, 2)]))
            inside_.insert(v);
          const int w = triangles_(of, (k + 1) % 3);
          if (edges_[edge_from_[v]].b != w) continue;
          for (int l = 0; l < 3; ++l) {
            const int c = triangles_(in, l), d = triangles_(in, (l + 1) % 3);
            if (edge_from_[c] < 0 || edges_[edge_from_[c]].b != d) continue;
            const Complex along = uv[d] - uv[c];
            const double left_v = Cross(along, uv[v] - uv[c]), left_w = Cross(along, uv[w] - uv[c]);
            const Complex other = uv[w] - uv[v];
            if (left_v * left_w < 0 && Cross(other, uv[c] - uv[v]) * Cross(other, uv[d] - uv[v]) < 0)
              inside_.insert(left_v > 0 ? v : w);
          }
        }
    active_.insert(inside_.begin(), inside_.end());
    MeasureRim(uv);
  }

  // That bring all points out that are inside, and keep out those that were.
  VertexPulls Pulls(const PlanePoints& uv) const {
    VertexPulls pulls;
    for (int v : active_) {
      const Contact contact = inside_.count(v) > 0 ? WayOut(v, uv) : Nearest(v, uv);
      if (contact.edge < 0) continue;
      const auto& [a, b, loop] = edges_[contact.edge];
      const double open = (gap_ * std::abs(uv[b] - uv[a]) - contact.apart) / 2;
      if (!(open > 0)) continue;
      for (const auto& [w, direction, share] :
           {std::tuple{v, contact.direction, 1.0}, std::tuple{a, -contact.direction, 1 - contact.along},
            std::tuple{b, -contact.direction, contact.along}}) {
        constexpr double kStiffness = 5;
        pulls.push_back(
            {static_cast<size_t>(w), direction, Dot(direction, uv[w]) + open, share * kStiffness});
      }
    }
    return pulls;
  }

 private:
  struct Edge {
    int a, b, loop;  // the chart is on its left
  };
  // Of a point of the rim with another place of it.
  struct Contact {
    int edge = -1;        // -1: none
    double along = 0;     // where on the edge, 0..1
    double apart = 0;     // less than 0 when the point is inside
    Complex direction{};  // in which the point gets away from the edge
  };

  void MeasureRim(const PlanePoints& uv) {
    arc_.assign(edges_.size() + 1, 0);
    for (size_t e = 0; e < edges_.size(); ++e)
      arc_[e + 1] = arc_[e] + std::abs(uv[edges_[e].b] - uv[edges_[e].a]);
  }

  // How far it is along the rim from a point of it to a place of an edge; infinite on another loop.
  double AlongRim(int v, int e, double t) const {
    const int from = edge_from_[v];
    if (edges_[from].loop != edges_[e].loop) return std::numeric_limits<double>::infinity();
    const auto [first, count] = loops_[edges_[e].loop];
    const double way = std::abs(arc_[e] + t * (arc_[e + 1] - arc_[e]) - arc_[from]),
                 all = arc_[first + count] - arc_[first];
    return std::min(way, all - way);
  }

  // To where a point comes out when its own rim is drawn back.
  Contact WayOut(int v, const PlanePoints& uv) const {
    const int next = edge_from_[v];
    const auto [first, count] = loops_[edges_[next].loop];
    const int before = edges_[next == first ? first + count - 1 : next - 1].a;
    const Complex own =
        (uv[v] - uv[before]) / std::max(std::abs(uv[v] - uv[before]), kNothing) +
        (uv[edges_[next].b] - uv[v]) / std::max(std::abs(uv[edges_[next].b] - uv[v]), kNothing);
    Contact best;
    if (!(std::abs(own) > kNothing)) return best;
    best.direction = Complex(0, 1) * own / std::abs(own);
    best.apart = -kDeepest;
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
      if (edges_[e].a == v || edges_[e].b == v) continue;
      const Complex &a = uv[edges_[e].a], edge = uv[edges_[e].b] - a, from = a - uv[v];
      const double steep = Cross(best.direction, edge);
      if (!(steep > 0)) continue;  // not from inside
      const double way = Cross(from, edge) / steep, along = Cross(from, best.direction) / steep;
      if (!(way >= 0 && way < -best.apart && along >= 0 && along <= 1)) continue;
      best.edge = e;
      best.along = along;
      best.apart = -way;
    }
    return best;
  }

  // The nearest place of the rim, but for what hangs together with the point.
  Contact Nearest(int v, const PlanePoints& uv) const {
    constexpr double kLocal = 1.15;  // the way along the rim, straight ways
    Contact best;
    best.apart = kDeepest;
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
      const Complex &a = uv[edges_[e].a], edge = uv[edges_[e].b] - a, from = uv[v] - a;
      if (edges_[e].a == v || edges_[e].b == v || !(std::norm(edge) > 0)) continue;
      const double along = std::clamp(Dot(from, edge) / std::norm(edge), 0.0, 1.0);
      const Complex way = from - along * edge;
      const double distance = std::abs(way);
      if (distance >= best.apart || AlongRim(v, e, along) < kLocal * distance) continue;
      best = {e, along, distance,
              distance > kNothing ? way / distance : Complex(0, -1) * edge / std::abs(edge)};
    }
    return best;
  }

  static constexpr double kNothing = 1e-12, kDeepest = 0.15;  // for a chart of area 1

  const Triangles& triangles_;
  const double gap_;  // lengths of an edge
  std::vector<Edge> edges_;
  std::vector<std::pair<int, int>> loops_;  // first edge, number of edges
  std::vector<int> edge_from_;              // per vertex, -1 inside
  std::vector<double> arc_;                 // where each edge starts
  std::set<int> inside_, active_;           // vertices that are inside, or were
};

/// Draws the parts of a map apart.
class ApartDrawer {
 public:
  ApartDrawer(const ChartMesh& chart, const RestShapes& shapes, double gap, const std::function<void()>& poll)
      : chart_(chart),
        shapes_(shapes),
        poll_(poll),
        system_(static_cast<int>(chart.positions.rows()), chart.triangles),
        contacts_(chart.triangles, gap) {}

  // False when they don't come apart.
  bool Run(PlanePoints& map) {
    constexpr int kRounds = 12, kStepsPerRound = 2, kPatience = 4;
    constexpr int kFew = 2000, kShare = 5;  // pairs; triangles for each
    const size_t most = std::max(kFew, static_cast<int>(chart_.triangles.rows()) / kShare);
    size_t fewest = most;
    int without_gain = 0;
    for (int round = 0; round <= kRounds && without_gain < kPatience; ++round) {
      const auto overlapping = OverlapsInMap(ToPoints(map, 1.0), chart_.triangles, most, poll_);
      if (overlapping.empty()) return true;
      if (overlapping.size() == most || round == kRounds) return false;
      without_gain = overlapping.size() < fewest ? 0 : without_gain + 1;
      fewest = std::min(fewest, overlapping.size());
      contacts_.Find(overlapping, map);
      Step({StretchEnergy::Kind::kSander}, kStepsPerRound, map);
    }
    return false;
  }

  // Where they were drawn, triangles are crumpled: the worst of it is spread out.
  void SpreadOut(PlanePoints& map) {
    constexpr int kSteps = 5;
    constexpr double kOfWorst = 0.85;
    PlanePoints spread = map;
    double worst = Worst(map);
    for (int step = 0; step < kSteps; ++step) {
      contacts_.Find({}, spread);
      Step({StretchEnergy::Kind::kSanderTail, 6, kOfWorst * worst}, 1, spread);
      if (OverlapsItself(ToPoints(spread, 1.0), chart_.triangles, poll_) && !Run(spread)) return;
      const double now = Worst(spread);
      if (!(now < worst)) continue;
      worst = now;
      map = spread;
    }
  }

 private:
  double Worst(const PlanePoints& map) const { return MeasureStretch(chart_, ToPoints(map, 1.0)).Linf(); }

  void Step(const StretchEnergy& energy, int count, PlanePoints& map) {
    const VertexPulls pulls = contacts_.Pulls(map);
    DescentOptions steps{StepKind::kProjectedNewton, count, 0};
    steps.pulls = &pulls;
    Descend(energy, steps, chart_.triangles, shapes_, system_, poll_, map);
  }

  const ChartMesh& chart_;
  const RestShapes& shapes_;
  const std::function<void()>& poll_;
  VertexBlockSystem system_;
  Contacts contacts_;
};

constexpr double kGap = 0.1;

// Unless parts lap over each other then.
void LowerWorst(const Triangles& triangles, const RestShapes& shapes, const std::function<void()>& poll,
                PlanePoints& map) {
  PlanePoints lower = map;
  VertexSweeps(static_cast<int>(map.size()), triangles, shapes).LowerWorst(poll, lower);
  if (!OverlapsItself(ToPoints(lower, 1.0), triangles, poll)) map = std::move(lower);
}

// Brings a map to its best size, and lets slivers be. False when it flips.
bool MadeReady(const Triangles& triangles, RestShapes& shapes, PlanePoints& map) {
  if (!std::isfinite(ScaleToBest(triangles, shapes, map))) return false;
  RelaxSlivers(triangles, map, shapes);
  return true;
}

// A map of the chart whose parts are at least `gap` apart, lengths of rim edges; nothing when there is none.
std::optional<PlanePoints> ApartFrom(const ChartMesh& normalized, PlanePoints map, double gap,
                                     ApartMapFor use, const std::function<void()>& poll) {
  RestShapes shapes = RestShapesOf(normalized);
  if (!MadeReady(normalized.triangles, shapes, map)) return std::nullopt;
  ApartDrawer drawer(normalized, shapes, gap, poll);
  if (!drawer.Run(map)) return std::nullopt;
  if (use == ApartMapFor::kMeasuring) return map;
  drawer.SpreadOut(map);
  LowerWorst(normalized.triangles, shapes, poll, map);
  return map;
}

// No rows when there is none.
Points2 FlatApart(const ChartMesh& chart, double gap, ApartMapFor use, const std::function<void()>& poll,
                  CoarserCharts* known) {
  const NormalizedChart normalized = Normalized(chart);
  if (IsLargeChart(chart)) {
    RestShapes shapes = RestShapesOf(normalized.mesh);
    const auto flatten = [&](const ChartMesh& coarse, CoarserCharts* coarser) {
      return FlatApart(coarse, gap, use, poll, coarser);
    };
    const std::optional<PlanePoints> map = MapFromCoarser(normalized, known, flatten, poll, shapes);
    return map ? ToPoints(*map, normalized.scale) : Points2();
  }
  const TrialFlattening flat = TrialFlatten(chart, {}, poll);
  if (!flat.ok) return Points2();
  const std::optional<PlanePoints> map = ApartFrom(normalized.mesh, ToPlanePoints(flat.uv), gap, use, poll);
  return map ? ToPoints(*map, normalized.scale) : Points2();
}

// A map continued from one of a coarser chart, whose parts are farther apart. `normalized`: of `chart`.
std::optional<PlanePoints> ApartFromCoarser(const ChartMesh& chart, const ChartMesh& normalized,
                                            ApartMapFor use, const std::function<void()>& poll,
                                            CoarserCharts* coarser) {
  constexpr double kWideGap = 0.3;
  const Points2 uv = FlatApart(chart, kWideGap, use, poll, coarser);
  if (uv.rows() == 0 || OverlapsItself(uv, chart.triangles, poll)) return std::nullopt;
  RestShapes shapes = RestShapesOf(normalized);
  PlanePoints map = ToPlanePoints(uv);
  if (!MadeReady(chart.triangles, shapes, map)) return std::nullopt;
  if (use == ApartMapFor::kAtlas) LowerWorst(chart.triangles, shapes, poll, map);
  return map;
}

}  // namespace

std::optional<ApartMap> LayApart(const ChartMesh& chart, const Points2& uv, double l2_bound, ApartMapFor use,
                                 const std::function<void()>& poll, CoarserCharts* coarser) {
  const NormalizedChart normalized = Normalized(chart);
  if (!(normalized.scale > 0)) return std::nullopt;
  std::optional<PlanePoints> map = IsLargeChart(chart)
                                       ? ApartFromCoarser(chart, normalized.mesh, use, poll, coarser)
                                       : ApartFrom(normalized.mesh, ToPlanePoints(uv), kGap, use, poll);
  if (!map) return std::nullopt;
  const StretchFigures figures = MeasureStretch(normalized.mesh, ToPoints(*map, 1.0));
  if (!(figures.L2() <= l2_bound)) return std::nullopt;
  const double scale = normalized.scale * std::sqrt(figures.SurfaceArea() / figures.UvArea());
  return ApartMap{ToPoints(*map, scale), figures.L2(), figures.Linf()};
}

}  // namespace dcharts
