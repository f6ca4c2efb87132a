// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "common/errors.h"
#include "common/progress.h"
#include "common/threads.h"

namespace dcharts {

/// Calls work(k, poll) for k = 0..count-1, on ThreadCount() threads; each call must write
/// only what is its own, so that the result doesn't depend on the number of threads. `poll` is for the work
/// to call now and then: it asks the progress (on the calling thread) whether to go on. A stage may have any
/// number of such loops: each takes two thirds of what is left of the stage's progress. An exception stops
/// all and is rethrown.
template <class Work>
void ParallelFor(int count, Progress& progress, const Work& work) {
  std::atomic<bool> stop{false};
  std::atomic<int> next{0}, done{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const double before = progress.Done(), share = 2.0 / 3 * (1 - before);
  const auto work_until_empty = [&](bool asks) {
    try {
      const std::function<void()> poll = [&] {
        if (stop) throw Cancelled();
        if (!asks) return;
        progress.Update(before + share * done / count);
        progress.Poll();
      };
      for (int k = next++; k < count && !stop; k = next++) {
        poll();
        work(k, poll);
        ++done;
      }
      // The calling thread alone may talk to the host: it stays awake for the others.
      while (asks && done < count && !stop) {
        poll();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!failure) failure = std::current_exception();
      stop = true;
    }
  };
  OnThreads(std::min(ThreadCount(), count) - 1, work_until_empty);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace dcharts
