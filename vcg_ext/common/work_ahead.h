// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "common/threads.h"

namespace dcharts {

/// To be called now and then by a work: may rest, and throws where the work is not to go on.
using Poll = std::function<void()>;

/// Work in steps that may be needed later, done ahead while threads have nothing else to do. What comes of it
/// must not hang on when it is done, so that the result doesn't depend on the number of threads.
class WorkAhead {
 public:
  using Step = std::function<void(const Poll& poll)>;

  explicit WorkAhead(std::vector<Step> steps) : steps_(std::move(steps)) {}
  WorkAhead(const WorkAhead&) = delete;
  ~WorkAhead();  ///< gives up what isn't done

  /// Begins on a spare thread, if there is one and it has not begun.
  void Begin();

  /// A poll for what is done meanwhile: calls `poll`, which may be null, and begins once that has lasted long
  /// and a thread is idle.
  Poll BeginningAfter(std::chrono::milliseconds patience, const Poll& poll);

  /// Returns when the first `count` steps are done; does them on this thread, if none has begun. Rethrows
  /// what they, or `poll`, which may be null, threw.
  void Finish(std::size_t count, const Poll& poll);

 private:
  void Work();

  const std::vector<Step> steps_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
  std::mutex mutex_;  // of the two
  std::condition_variable changed_;
  std::atomic<bool> is_given_up_{false};
  std::optional<SpareThread> thread_;
};

}  // namespace dcharts
