// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/chart_ids.h"
#include "planar/border_lines.h"
#include "planar/collapsing_mesh.h"
#include "planar/quadric.h"

namespace dcharts {

/// What a vertex may do while edges are collapsed.
enum VertexFreedom : char {
  kMayMove = 0,
  kStays,  ///< others may be moved onto it
  kApart  ///< stays, and no other is moved onto it: some of its faces aren't there, so it may be several fans
};

/// A surface with charts, of which edges are to be collapsed. What collapses cost is told by the quadrics.
struct CollapseTask {
  std::vector<Eigen::Vector3d> positions;  ///< per vertex
  std::vector<Quadric> quadrics;           ///< per vertex
  std::vector<char> freedom;               ///< per vertex: VertexFreedom
  std::vector<int> vertex, opposite;       ///< per half-edge, see CollapsingMesh
  ChartIds ids;                            ///< per face
};

/// The collapses that made a coarse surface, in their order. At each the vertex had the corners of `ring`
/// around it, counterclockwise; those of a vertex at the border run from border to border.
struct CollapseHistory {
  struct Step {
    int vertex;
    int ring_begin;  ///< in `rings`; the ring ends where that of the next step begins
    bool closed;
  };
  std::vector<Step> steps;
  std::vector<int> rings;
  /// Where runs of steps begin, by phases: a step hangs on those of its run and of other phases only.
  std::vector<std::vector<int>> phases;
};

/// Collapses edges, the cheapest first.
class EdgeCollapser {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  EdgeCollapser(CollapseTask task, bool keeps_history, const std::function<void()>& poll);
  EdgeCollapser(const EdgeCollapser&) = delete;

  /// Until at most `target_faces` are left, or each collapse costs more than `most_cost`, or none is allowed.
  /// May be called again to go on.
  void Run(int target_faces, double most_cost, const std::function<void()>& poll);

  const CollapsingMesh& Mesh() const { return mesh_; }
  const Quadric& QuadricOf(int v) const { return task_.quadrics[v]; }
  const CollapseHistory& History() const { return history_; }
  /// Of a face that was taken out: one that was beside it then, of its chart where there was one.
  int Heir(int face) const { return heir_[face]; }
  /// Half of the vertices that may move cost at least as much at first, about.
  double MedianCost() const { return median_cost_; }

 private:
  struct Shape {
    Eigen::Vector3d normal;  // as long as twice the area
    double twice_area;
    double quality;  // 1 for an equilateral triangle, 0 for one without area
  };
  using Spoke = CollapsingMesh::Spoke;

  static Shape ShapeOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  void CountFaces();
  double Bound(int u, int v) const;
  double LeastBound(int u);
  void Push(int u, double key);
  double BestCollapse(int u, Spoke& best);
  bool ChartsKeepEnough(int half_edge) const;
  bool TooManySpokes(int v);
  void ShapesAround(int u);
  double ShapeFactor(int v) const;
  void Collapse(int u, const Spoke& e);
  void Inherit(int half_edge);
  void Record(int u);

  CollapseTask task_;
  CollapsingMesh mesh_;
  BorderLines lines_;
  const bool keeps_history_;
  CollapseHistory history_;
  std::vector<int> heir_;
  std::vector<int> faces_, least_faces_;  // per chart, the first for unassigned faces
  // Vertices by the cost of their cheapest move, or less; an entry is out of date when it differs from key_.
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
  std::vector<double> key_;
  double median_cost_ = kNever;
  std::vector<Spoke> spokes_;
  std::vector<int> ring_, ring_v_;
  std::vector<Shape> ring_shapes_;  // per face of ring_
  double worst_around_ = 1;         // quality of these
};

}  // namespace dcharts
