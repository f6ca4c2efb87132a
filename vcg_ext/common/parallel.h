// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <exception>
#include <functional>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "common/errors.h"
#include "common/progress.h"

namespace dcharts {

/// Calls work(k, poll) for k = 0..count-1, on several threads where OpenMP is there; each call must write
/// only what is its own, so that the result doesn't depend on the number of threads. `poll` is for the work
/// to call now and then: it asks the progress (on the calling thread) whether to go on. The first exception
/// (by k) is rethrown when all have stopped.
template <class Work>
void ParallelFor(int count, Progress& progress, const Work& work) {
  std::atomic<bool> stop{false};
  std::atomic<int> done{0};
  std::exception_ptr failure;
  int failed_at = count;
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic, 1)
#endif
  for (int k = 0; k < count; ++k) {
    if (stop) continue;
#ifdef _OPENMP
    const bool asks = omp_get_thread_num() == 0;
#else
    const bool asks = true;
#endif
    try {
      const std::function<void()> poll = [&] {
        if (stop) throw Cancelled();
        if (asks) progress.Update(static_cast<double>(done) / count), progress.Poll();
      };
      poll();
      work(k, poll);
      ++done;
    } catch (...) {
#ifdef _OPENMP
#pragma omp critical(dcharts_parallel_for)
#endif
      {
        // A Cancelled that only follows another's stop comes later and doesn't count.
        if (!failure || (!stop && k < failed_at)) {
          failure = std::current_exception();
          failed_at = k;
        }
        stop = true;
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace dcharts
