// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/dart_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/threads.h"
#include "planar/distortion.h"
#include "surface/carried_map.h"
#include "surface/patch_paths.h"

namespace dcharts {
namespace {

// Area-weighted mean of the worst stretch of the faces around each vertex.
std::vector<double> VertexStretch(const ChartPatch& patch, const Points2& uv) {
  std::vector<double> sum(patch.VertexCount(), 0), weight(patch.VertexCount(), 0);
  for (int f = 0; f < static_cast<int>(patch.faces.size()); ++f) {
    Eigen::Matrix3d corners;
    Eigen::Matrix<double, 3, 2> flat;
    for (int i = 0; i < 3; ++i) {
      corners.row(i) = patch.mesh.positions.row(patch.mesh.triangles(f, i));
      flat.row(i) = uv.row(patch.mesh.triangles(f, i));
    }
    const TriangleStretch stretch = StretchOfTriangle(corners, flat);
    for (int i = 0; i < 3; ++i) {
      sum[patch.mesh.triangles(f, i)] += stretch.surface_area * stretch.largest;
      weight[patch.mesh.triangles(f, i)] += stretch.surface_area;
    }
  }
  for (int v = 0; v < patch.VertexCount(); ++v) sum[v] = weight[v] > 0 ? sum[v] / weight[v] : 0;
  return sum;
}

// Of a value per vertex, the mean over what is nearer than about a twentieth of the chart's width.
std::vector<double> Smoothed(const ChartPatch& patch, std::vector<double> value) {
  constexpr double kRoundsPerVertex = 0.005;
  constexpr int kMostRounds = 200;
  const int rounds = std::min(kMostRounds, static_cast<int>(kRoundsPerVertex * patch.VertexCount()));
  std::vector<double> sum;
  std::vector<int> faces(patch.VertexCount(), 0);
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) ++faces[patch.Vertex(h)];
  for (int round = 0; round < rounds; ++round) {
    sum.assign(value.size(), 0);
    for (int f = 0; f < static_cast<int>(patch.faces.size()); ++f) {
      const auto corner = [&](int i) { return patch.mesh.triangles(f, i); };
      const double mean = (value[corner(0)] + value[corner(1)] + value[corner(2)]) / 3;
      for (int i = 0; i < 3; ++i) sum[corner(i)] += mean;
    }
    for (size_t v = 0; v < value.size(); ++v) value[v] = sum[v] / faces[v];
  }
  return value;
}

// A dart is worth its length when the worst stretch falls by as much as this for each unit of it, or, where
// the mean stretch is too high, when that falls by a fair share.
constexpr double kLinfPerUnit = 1.5;
constexpr double kShareOfL2 = 0.1;

// What the mean stretch may be at most with a dart that helps.
double MostL2(const Flattening& before, const DartGoal& goal) {
  if (before.l2_stretch <= goal.l2_stretch) return goal.l2_stretch;
  return 1 + (1 - kShareOfL2) * (before.l2_stretch - 1);
}

bool Helps(const Flattening& before, const Flattening& after, double length, const DartGoal& goal) {
  if (!after.ok || after.l2_stretch > MostL2(before, goal)) return false;
  if (before.l2_stretch > goal.l2_stretch) return true;
  return before.linf_stretch - std::max(after.linf_stretch, goal.linf_stretch) >
         kLinfPerUnit * length / goal.unit;
}

// False when no dart as long as this helps, whatever it does.
bool MayHelp(const Flattening& before, double length, const DartGoal& goal) {
  return before.l2_stretch > goal.l2_stretch ||
         before.linf_stretch - goal.linf_stretch > kLinfPerUnit * length / goal.unit;
}

class DartSearch {
 public:
  DartSearch(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart)
      : goal_(goal), poll_(poll), chart_(chart), hopeless_(chart.patch.faces.size(), 0) {}

  void Run() {
    // Trials with the finish take several times as long.
    const int most_failures = HasFinish(goal_) ? 2 : 4;
    for (int failures = 0;
         chart_.count < goal_.most_darts && failures < most_failures && !Reached(chart_.flat, goal_);) {
      PatchPaths paths(chart_.patch);
      paths.Run(paths.BoundaryVertices(), true);
      const std::vector<double> stretch = VertexStretch(chart_.patch, chart_.flat.uv);
      const int worst = Worst(paths, stretch);
      if (worst < 0) return;
      std::vector<int> tips = Tips(paths, stretch, worst);
      const std::vector<char> hopeless = WithAround(worst, paths);
      TryThoseThatMayWin(
          paths, tips,
          failures + 1 < most_failures ? TipsThen(paths, stretch, hopeless) : std::vector<int>());
      if (CutBest(paths, tips)) continue;
      ++failures;
      hopeless_ = hopeless;
    }
  }

 private:
  // A corner at the vertex of the largest value of those that a dart may go to; -1 when there is none.
  template <class Value>
  int Best(const PatchPaths& paths, const Value& value) const {
    int best = -1;
    for (int h = 0; h < chart_.patch.HalfEdgeCount(); ++h) {
      const int v = chart_.patch.Vertex(h);
      if (hopeless_[h / 3] || paths.OnBoundary(v) || !(paths.Distance(v) <= goal_.longest)) continue;
      if (best < 0 || value(v) > value(chart_.patch.Vertex(best))) best = h;
    }
    return best;
  }

  int Worst(const PatchPaths& paths, const std::vector<double>& stretch) const {
    return Best(paths, [&](int v) { return stretch[v]; });
  }

  // Where darts may go instead of the worst corner, too.
  std::vector<int> Tips(const PatchPaths& paths, const std::vector<double>& stretch, int worst) const {
    // A dart relieves a disk as wide as it is long, so the mean stretch around its tip counts for more than
    // that at it. A round chart is stretched most at its rim, and yet a cut to its middle may relieve it
    // more.
    if (chart_.flat.l2_stretch <= goal_.l2_stretch) return {worst};
    const std::vector<double> around = Smoothed(chart_.patch, stretch);
    std::vector<int> tips{worst};
    for (int tip : {Best(paths, [&](int v) { return around[v]; }),
                    Best(paths, [&](int v) { return paths.Distance(v); })})
      if (!IsNearOneOf(paths, tips, tip)) tips.push_back(tip);
    return tips;
  }

  // Where darts go next if none helps now. Most don't, so these are tried ahead; of a small chart that
  // isn't worth it.
  std::vector<int> TipsThen(const PatchPaths& paths, const std::vector<double>& stretch,
                            std::vector<char> hopeless) {
    constexpr size_t kManyTriangles = 15000;
    if (FreeThreads() == 0 || (!goal_.is_of_large && chart_.patch.faces.size() < kManyTriangles)) return {};
    hopeless_.swap(hopeless);
    const int next = Worst(paths, stretch);
    std::vector<int> tips = next >= 0 ? Tips(paths, stretch, next) : std::vector<int>();
    hopeless_.swap(hopeless);
    return tips;
  }

  // A dart to a place near the end of another one does about the same.
  bool IsNearOneOf(const PatchPaths& paths, const std::vector<int>& tips, int tip) const {
    constexpr double kNear = 0.1;  // of its length
    const Points3& at = chart_.patch.mesh.positions;
    const auto place = [&](int corner) { return at.row(chart_.patch.Vertex(corner)); };
    return std::any_of(tips.begin(), tips.end(), [&](int other) {
      return (place(tip) - place(other)).norm() <= kNear * Length(paths, tip);
    });
  }

  double Length(const PatchPaths& paths, int tip) const { return paths.Distance(chart_.patch.Vertex(tip)); }

  // What a dart brings. By its length alone, many small ones would come before the one that does the work.
  double Gain(double l2_stretch, double length) const {
    return (chart_.flat.l2_stretch - std::max(l2_stretch, goal_.l2_stretch)) / std::sqrt(length);
  }

  // Makes the trials that have not been made, the shortest first, but for those that can't win any more, and
  // some of `ahead` meanwhile.
  void TryThoseThatMayWin(const PatchPaths& paths, std::vector<int> tips, const std::vector<int>& ahead) {
    std::stable_sort(tips.begin(), tips.end(),
                     [&](int a, int b) { return Length(paths, a) < Length(paths, b); });
    double best = -std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < tips.size();) {
      std::vector<int> some;
      for (; k < tips.size() && some.size() <= static_cast<size_t>(FreeThreads()); ++k)
        if (!(Gain(goal_.l2_stretch, Length(paths, tips[k])) < best)) some.push_back(tips[k]);
      TryAll(paths, some, ahead);
      for (int tip : some)
        if (const DartedChart& trial = trials_.at(tip); trial.count > 0)
          best = std::max(best, Gain(trial.flat.l2_stretch, Length(paths, tip)));
    }
  }

  // Makes the trials that have not been made, and, on threads that are idle, some of `ahead`.
  void TryAll(const PatchPaths& paths, std::vector<int> tips, const std::vector<int>& ahead) {
    for (int tip : tips)
      if (!MayHelp(chart_.flat, Length(paths, tip), goal_)) trials_.emplace(tip, DartedChart());
    const auto is_made = [&](int tip) { return trials_.count(tip) > 0; };
    tips.erase(std::remove_if(tips.begin(), tips.end(), is_made), tips.end());
    if (tips.empty()) return;
    const int count = static_cast<int>(tips.size());
    for (int tip : ahead)
      if (!is_made(tip) && std::find(tips.begin(), tips.end(), tip) == tips.end() &&
          MayHelp(chart_.flat, Length(paths, tip), goal_))
        tips.push_back(tip);
    // Most darts don't help, which shows in a map without the finish, made from the one the chart has.
    if (!plain_) {
      plain_ = HasFinish(goal_) ? FlatWithoutFinish(chart_.patch, &chart_.flat.uv, poll_) : chart_.flat;
    }
    std::vector<std::optional<DartedChart>> made(tips.size());
    InParallelWithAhead(count, static_cast<int>(tips.size()) - count, poll_,
                        [&](int k, const std::function<void()>& poll) {
                          const int v = chart_.patch.Vertex(tips[k]);
                          DartedChart trial;
                          if (!Try(tips[k], paths.Path(v), Length(paths, tips[k]), poll, trial)) trial = {};
                          made[k] = std::move(trial);
                        });
    for (size_t k = 0; k < tips.size(); ++k)
      if (made[k]) trials_.emplace(tips[k], std::move(*made[k]));
  }

  // Cuts the best dart to one of the tips that have been tried, if any helps.
  bool CutBest(const PatchPaths& paths, const std::vector<int>& tips) {
    double best_gain = -1;
    DartedChart best;
    for (int tip : tips) {
      const auto found = trials_.find(tip);
      if (found == trials_.end() || found->second.count == 0) continue;
      DartedChart& trial = found->second;
      const double gain = Gain(trial.flat.l2_stretch, Length(paths, tip));
      if (best.count > 0 && gain <= best_gain) continue;
      best_gain = gain;
      best = std::move(trial);
    }
    if (best.count == 0) return false;
    best.edges.insert(best.edges.begin(), chart_.edges.begin(), chart_.edges.end());
    best.tips.insert(best.tips.begin(), chart_.tips.begin(), chart_.tips.end());
    best.count += chart_.count;
    best.l2_uncut = chart_.l2_uncut;
    chart_ = std::move(best);
    plain_.reset();
    trials_.clear();
    return true;
  }

  // One more dart; false when it doesn't help.
  bool Try(int tip, const std::vector<int>& cut, double length, const std::function<void()>& poll,
           DartedChart& trial) const {
    trial = Uncut(CutOpen(chart_.patch, cut));
    trial.edges = cut;
    trial.count = 1;
    trial.tips.push_back(tip);
    const Points2 start = CarriedMap(chart_.patch, plain_->ok ? plain_->uv : chart_.flat.uv, trial.patch);
    DartGoal goal = goal_;
    if (chart_.flat.l2_stretch <= goal.l2_stretch)  // though not quite by the quick map
      goal.l2_stretch = std::max(goal.l2_stretch, plain_->l2_stretch);
    trial.flat = FlatWithoutFinish(trial.patch, &start, poll, nullptr, MostL2(*plain_, goal));
    if (!Helps(*plain_, trial.flat, length, goal)) return false;
    if (!HasFinish(goal_)) {
      // What laps over a little may not do so with the finish.
      constexpr size_t kLittle = 20;
      const size_t overlaps = CountOverlaps(trial, kLittle);
      if (overlaps == 0) return true;
      if (overlaps == kLittle) return false;
    }
    // Parameterize has no start: the atlas's map must not have one.
    trial.flat = FlatWithFinish(trial.patch, goal_, poll, HasFinish(goal_) ? nullptr : &trial.flat.uv);
    return Helps(chart_.flat, trial.flat, length, goal_) && !Overlaps(trial);
  }

  // The faces without hope once a dart to this corner is of no use: no darts to anywhere near.
  std::vector<char> WithAround(int corner, const PatchPaths& paths) const {
    const double distance = paths.Distance(chart_.patch.Vertex(corner));
    std::vector<char> hopeless = hopeless_;
    PatchPaths around(chart_.patch);
    around.Run({chart_.patch.Vertex(corner)}, false);
    for (int h = 0; h < chart_.patch.HalfEdgeCount(); ++h)
      if (around.Distance(chart_.patch.Vertex(h)) <= distance) hopeless[h / 3] = 1;
    return hopeless;
  }

  const DartGoal& goal_;
  const std::function<void()>& poll_;
  DartedChart& chart_;
  std::optional<Flattening> plain_;    // of the chart as it is now, without the finish
  std::map<int, DartedChart> trials_;  // of the chart as it is now, by tip; without darts where none helps
  std::vector<char> hopeless_;         // faces
};

}  // namespace

void SearchDarts(const DartGoal& goal, const std::function<void()>& poll, DartedChart& chart) {
  DartSearch(goal, poll, chart).Run();
}

}  // namespace dcharts
