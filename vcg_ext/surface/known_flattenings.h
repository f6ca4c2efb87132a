// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "planar/flatten.h"
#include "surface/chart_patch.h"

namespace dcharts {

/// Charts that were flattened with least stretch by an earlier stage of the same run, so that a later one
/// need not do it again. It finds what it would have computed, as a chart's flattening depends on the chart
/// alone.
class KnownFlattenings {
 public:
  void Add(const ChartPatch& patch, Flattening flat) {
    known_[patch.faces.front()] = {patch.faces, patch.opposite, std::move(flat)};
  }

  /// Null when this very chart, cut in the same way, isn't known.
  const Flattening* Find(const ChartPatch& patch) const {
    const auto found = known_.find(patch.faces.front());
    if (found == known_.end() || found->second.faces != patch.faces ||
        found->second.opposite != patch.opposite)
      return nullptr;
    return &found->second.flat;
  }

 private:
  struct Entry {
    std::vector<int> faces, opposite;
    Flattening flat;
  };
  std::map<int, Entry> known_;  // by a chart's first face
};

}  // namespace dcharts
