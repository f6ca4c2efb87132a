// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace dcharts {

/// Which charts lie flat within a bound on the copy for checks, each checked once: several steps of Merge
/// come to the same chart.
class FineChecks {
 public:
  /// `parts`: of the chart, ascending.
  void Add(double bound, const std::vector<int>& parts, bool fits) { fits_[{bound, parts}] = fits; }

  /// Nothing when it isn't known.
  std::optional<bool> Find(double bound, const std::vector<int>& parts) const {
    const auto found = fits_.find({bound, parts});
    if (found == fits_.end()) return std::nullopt;
    return found->second;
  }

 private:
  std::map<std::pair<double, std::vector<int>>, bool> fits_;
};

}  // namespace dcharts
