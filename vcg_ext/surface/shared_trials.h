// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "surface/chart_trial.h"
#include "surface/known_trials.h"

namespace dcharts {

/// What was computed of charts of some parts for a bound on their stretch, which it hangs on alone. May be
/// used by several threads at once.
template <class Value>
class TrialsByParts {
 public:
  void Add(double bound, const std::vector<int>& parts, const Value& value) {
    const std::lock_guard<std::mutex> lock(mutex_);
    values_.try_emplace({bound, parts}, value);
  }

  /// Nothing when it isn't known.
  std::optional<Value> Find(double bound, const std::vector<int>& parts) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = values_.find({bound, parts});
    if (found == values_.end()) return std::nullopt;
    return found->second;
  }

 private:
  std::map<std::pair<double, std::vector<int>>, Value> values_;
  mutable std::mutex mutex_;
};

/// What all orders that charts are merged in share: each trial is made once.
struct SharedTrials {
  /// Of a chart on the copy for checks, that was mapped to its end.
  struct Map {
    bool fits = false;
    std::set<std::pair<int, int>> overlaps{};  ///< parts that overlap each other
  };
  /// Of a chart there, given up once it was sure to fail.
  struct Check {
    bool fits = false, overlaps = false;
  };
  TrialsByParts<ChartTrial> coarse{};  ///< on the copy for trials
  TrialsByParts<Check> checks{};
  TrialsByParts<Map> maps{};
  KnownTrials fine{};  ///< the maps that fit
};

}  // namespace dcharts
