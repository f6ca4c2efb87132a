// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "planar/trial_flatten.h"

namespace dcharts {

/// The maps of charts of one surface that a step of Merge has tried, for the next one: what it would compute
/// itself, with no bound and no start. May be used by several threads at once.
class KnownTrials {
 public:
  /// `faces`: of the chart, ascending. `flat`: of Opened(). Kept if it is a map within its bound: then the
  /// bound has changed nothing.
  void Add(const std::vector<int>& faces, TrialFlattening flat) {
    if (!flat.ok) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    flat_.try_emplace(faces, std::move(flat));
  }

  /// Null when it isn't known.
  const TrialFlattening* Find(const std::vector<int>& faces) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = flat_.find(faces);
    return found == flat_.end() ? nullptr : &found->second;
  }

 private:
  std::map<std::vector<int>, TrialFlattening> flat_;
  mutable std::mutex mutex_;
};

}  // namespace dcharts
