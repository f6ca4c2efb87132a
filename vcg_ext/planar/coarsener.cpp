// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/coarsener.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "common/half_edge.h"
#include "common/parallel.h"
#include "planar/quadric.h"
#include "planar/surface_blocks.h"

namespace dcharts {
namespace {

using Eigen::Vector3d;

// Chosen as those of EdgeCollapser.
constexpr double kBorderWeight = 3;      // of leaving a border line, against leaving the surface
constexpr double kSmallestChart = 1e-3;  // area, in parts of the mean; below it charts count as this large

class Coarsener {
 public:
  Coarsener(const FannedSurface& surface, const ChartIds& ids, CollapseHistory* history,
            const std::function<void()>& poll)
      : history_(history), poll_(poll), heir_(ids.size()), faces_(ids.size()) {
    task_.positions = surface.positions;
    task_.freedom = FreedomOf(surface);
    task_.vertex = surface.vertex;
    task_.opposite = surface.opposite;
    task_.ids = ids;
    std::iota(heir_.begin(), heir_.end(), 0);
    std::iota(faces_.begin(), faces_.end(), 0);
    Normalize();
    SumQuadrics();
  }

  void Run(int target_faces) {
    if (FaceCount() <= target_faces) return;
    constexpr int kManyOfCharts = 150000, kMany = 100000, kFacesPerBlock = 16384;
    // What lies beside the rim of a block stays finer; in the next blocks, or at last, that is made up for.
    constexpr int kAtOnce = 3;
    constexpr double kMore = 1.5;
    for (int many = HasCharts() ? kManyOfCharts : kMany; FaceCount() > std::max(many, 2 * target_faces);
         many = kMany) {
      const int before = FaceCount();
      const int goal = std::max(before / kAtOnce, static_cast<int>(kMore * target_faces));
      CollapseInBlocks(before / kFacesPerBlock + 1, goal);
      if (kMore * FaceCount() > before) break;
    }
    CollapseInHalves(target_faces);
    CollapseInBlocks(1, target_faces);
  }

  CoarsenedSurface Take() {
    CoarsenedSurface left;
    std::vector<int> place(heir_.size(), -1);
    for (int k = 0; k < FaceCount(); ++k) place[faces_[k]] = k;
    left.vertex.reserve(3 * faces_.size());
    left.opposite.reserve(3 * faces_.size());
    for (int f : faces_)
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int o = task_.opposite[h];
        left.vertex.push_back(task_.vertex[h]);
        left.opposite.push_back(o < 0 ? -1 : 3 * place[o / 3] + o % 3);
      }
    for (int f = 0; f < static_cast<int>(heir_.size()); ++f) {
      int last = f;
      while (place[last] < 0) last = heir_[last];
      for (int g = f; g != last;) {
        const int next = heir_[g];
        heir_[g] = last;
        g = next;
      }
    }
    left.heir = std::move(heir_);
    for (int& f : left.heir) f = place[f];
    left.source_face = std::move(faces_);
    return left;
  }

 private:
  int FaceCount() const { return static_cast<int>(faces_.size()); }

  // It is one, or has several.
  bool HasCharts() const { return history_ != nullptr || ChartCount(task_.ids) > 1; }

  // Those that stand for a part of a vertex only stay.
  static std::vector<char> FreedomOf(const FannedSurface& surface) {
    int source_count = 0;
    for (int s : surface.source_vertex) source_count = std::max(source_count, s + 1);
    std::vector<int> fans(source_count, 0);
    for (int s : surface.source_vertex) ++fans[s];
    std::vector<char> freedom;
    for (int s : surface.source_vertex) freedom.push_back(fans[s] > 1 ? kStays : kMayMove);
    return freedom;
  }

  // Costs are relative: to unit area, with the origin inside.
  void Normalize() {
    Vector3d low = Vector3d::Constant(EdgeCollapser::kNever), high = -low;
    for (const Vector3d& p : task_.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    double area = 0;
    for (int f : faces_) area += NormalOf(f).norm() / 2;
    const double scale = area > 0 ? 1 / std::sqrt(area) : 1;
    for (Vector3d& p : task_.positions) p = (p - (low + high) / 2) * scale;
  }

  Vector3d NormalOf(int f) const {
    const Vector3d &a = task_.positions[task_.vertex[3 * f]], &b = task_.positions[task_.vertex[3 * f + 1]],
                   &c = task_.positions[task_.vertex[3 * f + 2]];
    return (b - a).cross(c - a);
  }

  // Per chart, the first for unassigned faces.
  std::vector<double> ChartWeights() const {
    std::vector<int> count(ChartCount(task_.ids) + 1, 0);
    std::vector<double> area(count.size(), 0), weights;
    for (int f : faces_) {
      ++count[task_.ids[f] + 1];
      area[task_.ids[f] + 1] += NormalOf(f).norm() / 2;
    }
    const auto empty = std::count(count.begin(), count.end(), 0);
    const double charts = static_cast<double>(count.size()) - static_cast<double>(empty);
    for (double a : area) weights.push_back(1 / std::max(a * charts, kSmallestChart));
    return weights;
  }

  void SumQuadrics() {
    const std::vector<double> chart_weight = ChartWeights();
    task_.quadrics.resize(task_.positions.size());
    for (int f : faces_) {
      const Vector3d normal = NormalOf(f);
      const double norm = normal.norm();
      if (!(norm > 0)) continue;
      Quadric plane;
      plane.AddPlane(normal / norm, task_.positions[task_.vertex[3 * f]],
                     norm / 2 * chart_weight[task_.ids[f] + 1]);
      for (int h = 3 * f; h < 3 * f + 3; ++h) task_.quadrics[task_.vertex[h]] += plane;
    }
    for (int h = 0; h < 3 * FaceCount(); ++h) {
      const int o = task_.opposite[h];
      if (o >= 0 && task_.ids[o / 3] == task_.ids[h / 3]) continue;
      const int a = task_.vertex[h], b = task_.vertex[Next(h)];
      const Vector3d along = task_.positions[b] - task_.positions[a];
      const double squared = along.squaredNorm();
      if (!(squared > 0)) continue;
      Quadric line;
      line.AddLine(along / std::sqrt(squared), task_.positions[a],
                   kBorderWeight * squared * chart_weight[task_.ids[h / 3] + 1]);
      task_.quadrics[a] += line;
      task_.quadrics[b] += line;
    }
  }

  // The most of it, where it is worth while. Large halves have so little rim that hardly anything is to be
  // made up for. Not the surface that segments are to be grown on: they came out worse on one made of halves.
  void CollapseInHalves(int target_faces) {
    constexpr int kManyOfChart = 20000, kManyOfSurface = 50000, kAtOnce = 8;
    constexpr double kAboutAll = 1.05, kWorthWhile = 1.25;
    if (!HasCharts()) return;
    const bool is_chart = history_ != nullptr;
    const int goal = std::max(FaceCount() / kAtOnce, static_cast<int>(kAboutAll * target_faces));
    if (FaceCount() < (is_chart ? kManyOfChart : kManyOfSurface) || FaceCount() < kWorthWhile * goal) return;
    CollapseInBlocks(2, goal);
  }

  // Until about `goal` faces are left, each block by itself but all to the same cost; one block is exact.
  void CollapseInBlocks(int count, int goal) {
    const SurfaceBlocks blocks(task_, faces_, count);
    std::vector<std::unique_ptr<EdgeCollapser>> collapsers(count);
    InParallel(count, poll_, [&](int b, const std::function<void()>& poll) {
      collapsers[b] = std::make_unique<EdgeCollapser>(blocks.Task(b), history_ != nullptr, poll);
    });
    if (count == 1)
      collapsers[0]->Run(goal, EdgeCollapser::kNever, poll_);
    else  // where the blocks have few vertices for themselves, these are not to make up for the others
      RunToOneCost(FaceCount() - static_cast<int>(blocks.ShareOfInner() * (FaceCount() - goal)), collapsers);
    InParallel(count, poll_, [&](int b, const std::function<void()>&) {
      blocks.WriteBack(b, *collapsers[b], task_, heir_);
    });
    if (history_) history_->phases.emplace_back();
    for (int b = 0; b < count && history_; ++b) blocks.AppendHistory(b, collapsers[b]->History(), *history_);
    faces_.erase(std::remove_if(faces_.begin(), faces_.end(), [&](int f) { return task_.vertex[3 * f] < 0; }),
                 faces_.end());
  }

  void RunToOneCost(int goal, const std::vector<std::unique_ptr<EdgeCollapser>>& collapsers) const {
    constexpr double kLeastCost = 1e-18, kMostCost = 1e3, kStep = 1.15;
    double cost = kMostCost;
    for (const auto& collapser : collapsers) cost = std::min(cost, collapser->MedianCost());
    for (cost = std::max(cost, kLeastCost); cost < kMostCost; cost *= kStep) {
      InParallel(static_cast<int>(collapsers.size()), poll_,
                 [&](int b, const std::function<void()>& poll) { collapsers[b]->Run(0, cost, poll); });
      int faces = 0;
      for (const auto& collapser : collapsers) faces += collapser->Mesh().FaceCount();
      if (faces <= goal) return;
    }
  }

  CollapseHistory* history_;
  const std::function<void()>& poll_;
  CollapseTask task_;       // half-edges of faces that are gone start at vertex -1
  std::vector<int> heir_;   // of a face that is gone, one that was beside it then
  std::vector<int> faces_;  // that are left, ascending
};

}  // namespace

CoarsenedSurface Coarsened(const FannedSurface& surface, const ChartIds& ids, int target_faces,
                           CollapseHistory* history, const std::function<void()>& poll) {
  Coarsener coarsener(surface, ids, history, poll);
  coarsener.Run(target_faces);
  return coarsener.Take();
}

}  // namespace dcharts
