// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/progress.h"
#include "surface/chart_groups.h"
#include "surface/chart_trial.h"
#include "surface/charts.h"

namespace dcharts {

/// Halves of halves of a chart are often more pieces than it takes: puts together again what lies flat as
/// one.
template <class MeshType>
class PieceMerger {
 public:
  /// `seams`: between the pieces, and cuts in them that are to stay. All must outlive the merger.
  PieceMerger(const SurfaceGraph<MeshType>& surface, double l2_bound, SeamMask seams, Progress& progress)
      : surface_(surface), bound_(l2_bound), progress_(progress), seams_(std::move(seams)) {}

  /// `pieces`: the faces of each, ascending. The two with the longest common border that keep within the
  /// bound come together first. Returns the piece that each is a part of then.
  std::vector<int> Run(std::vector<std::vector<int>> pieces) {
    faces_ = std::move(pieces);
    const int count = static_cast<int>(faces_.size());
    std::vector<int> part_of(count);
    for (int p = 0; p < count; ++p) part_of[p] = p;
    for (Try(); !flat_.empty(); Try()) {
      const auto longest = std::max_element(flat_.begin(), flat_.end(), [&](const Pair& a, const Pair& b) {
        return std::make_pair(borders_[a].length, b) < std::make_pair(borders_[b].length, a);
      });
      const auto [a, b] = *longest;
      for (int h : borders_[*longest].half_edges) ClearSeam(seams_, h);
      faces_[a] = ChartGroups<MeshType>::Joined(faces_[a], faces_[b]);
      faces_[b].clear();
      for (int& part : part_of) part = part == b ? a : part;
      const auto is_old = [&](const Pair& pair) {
        return pair.first == a || pair.second == a || pair.first == b || pair.second == b;
      };
      for (std::set<Pair>* pairs : {&tried_, &flat_})
        for (auto at = pairs->begin(); at != pairs->end();) at = is_old(*at) ? pairs->erase(at) : ++at;
    }
    return part_of;
  }

 private:
  using Pair = std::pair<int, int>;
  struct Border {
    double length = 0;
    std::vector<int> half_edges{};  // on both sides
  };

  void FindBorders() {
    borders_.clear();
    std::vector<int> owner(surface_.FaceCount(), -1);
    for (int p = 0; p < static_cast<int>(faces_.size()); ++p)
      for (int f : faces_[p]) owner[f] = p;
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int g = surface_.Neighbour(h);
      if (g < 0 || owner[g] < 0 || owner[h / 3] < 0 || owner[g] == owner[h / 3]) continue;
      Border& border = borders_[std::minmax(owner[h / 3], owner[g])];
      border.length += surface_.Length(h) / 2;
      border.half_edges.push_back(h);
    }
    for (const auto& [h, o] : surface_.Parted())
      if (owner[h / 3] >= 0 && owner[o / 3] >= 0) borders_.erase(std::minmax(owner[h / 3], owner[o / 3]));
  }

  // All pairs that were not tried yet.
  void Try() {
    FindBorders();
    PatchExtractor<MeshType> extractor(surface_, seams_);
    std::vector<Pair> pairs;
    std::vector<ChartPatch> patches;
    for (const auto& [pair, border] : borders_) {
      if (!tried_.insert(pair).second) continue;
      for (int h : border.half_edges) ClearSeam(seams_, h);
      pairs.push_back(pair);
      patches.push_back(
          extractor.Extract(ChartGroups<MeshType>::Joined(faces_[pair.first], faces_[pair.second])));
      for (int h : border.half_edges) SetSeam(seams_, h);
    }
    std::vector<char> is_flat(pairs.size(), 0);
    ParallelForLargestFirst(
        static_cast<int>(pairs.size()), progress_, [&](int k) { return patches[k].faces.size(); },
        [&](int k, const std::function<void()>& poll) {
          is_flat[k] = TryChart(patches[k], bound_, poll).flat;
        });
    for (size_t k = 0; k < pairs.size(); ++k)
      if (is_flat[k]) flat_.insert(pairs[k]);
  }

  const SurfaceGraph<MeshType>& surface_;
  const double bound_;
  Progress& progress_;
  SeamMask seams_;
  std::vector<std::vector<int>> faces_;  // per piece; none of one that is a part of another
  std::map<Pair, Border> borders_;       // the smaller piece first
  std::set<Pair> tried_, flat_;
};

}  // namespace dcharts
