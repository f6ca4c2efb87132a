// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <numeric>
#include <optional>
#include <vector>

#include "common/errors.h"
#include "common/progress.h"
#include "common/threads.h"

namespace dcharts {

/// Calls work(k, poll) for k = 0..count-1, on this thread and those that are free or become so; each call
/// must write only what is its own, so that the result doesn't depend on the number of threads. `poll` is for
/// the work to call now and then: on the calling thread it calls ask(items done), which may throw; on others
/// it ends the work once another has thrown. An exception stops all and is rethrown.
template <class Ask, class Work>
void ShareOut(int count, const Ask& ask, const Work& work) {
  std::atomic<bool> stop{false};
  std::atomic<int> next{0}, done{0};
  std::mutex mutex;
  std::condition_variable ended;
  std::exception_ptr failure;
  const auto stop_if_it_throws = [&](const auto& part) {
    try {
      part();
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!failure) failure = std::current_exception();
      stop = true;
    }
  };
  const auto work_until_empty = [&](const std::function<void()>& poll) {
    for (int k = next++; k < count && !stop; k = next++) {
      poll();
      work(k, poll);
      ++done;
    }
  };
  const auto help = [&] {
    stop_if_it_throws([&] {
      work_until_empty([&] {
        if (stop) throw Cancelled();
      });
    });
    const std::lock_guard<std::mutex> lock(mutex);
    ended.notify_one();
  };
  {
    Helpers helpers(std::min(ThreadCount(), count) - 1, help);
    stop_if_it_throws([&] {
      const std::function<void()> poll = [&] {
        if (stop) throw Cancelled();
        if (next < count) helpers.StartFree();
        ask(static_cast<int>(done));
      };
      work_until_empty(poll);
      // This thread alone may talk to the host: it stays awake for the others.
      std::optional<WaitsForHelpers> waits;
      while (done < count && !stop) {
        if (!waits) waits.emplace();
        poll();
        std::unique_lock<std::mutex> lock(mutex);
        ended.wait_for(lock, std::chrono::milliseconds(1), [&] { return done >= count || stop; });
      }
    });
  }
  if (failure) std::rethrow_exception(failure);
}

/// ShareOut for a stage, whose progress is asked whether to go on. A stage may have any number of such loops:
/// each takes two thirds of what is left of the stage's progress.
template <class Work>
void ParallelFor(int count, Progress& progress, const Work& work) {
  const double before = progress.Done(), share = 2.0 / 3 * (1 - before);
  const auto ask = [&](int done) {
    progress.Update(before + share * done / count);
    progress.Poll();
  };
  ShareOut(count, ask, work);
}

/// ParallelFor with the largest item first, so that all threads end at about the same time.
template <class Size, class Work>
void ParallelForLargestFirst(int count, Progress& progress, const Size& size, const Work& work) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size(a) > size(b); });
  ParallelFor(count, progress, [&](int k, const std::function<void()>& poll) {
    work(order[static_cast<std::size_t>(k)], poll);
  });
}

/// ShareOut for a part of a work that may run beside others; `poll`, which may be null, is that work's.
template <class Work>
void InParallel(int count, const std::function<void()>& poll, const Work& work) {
  const auto ask = [&](int) {
    if (poll) poll();
  };
  ShareOut(count, ask, work);
}

/// InParallel where that is worth it, else on this thread alone.
template <class Work>
void InParallelIf(bool is_worth_it, int count, const std::function<void()>& poll, const Work& work) {
  if (is_worth_it)
    InParallel(count, poll, work);
  else
    for (int k = 0; k < count; ++k) work(k, poll);
}

/// InParallel, but for items that are in vain: those for which is_in_vain(k) are not begun, or are given up
/// by `poll`.
template <class IsInVain, class Work>
void InParallelUnless(const IsInVain& is_in_vain, int count, const std::function<void()>& poll,
                      const Work& work) {
  struct GivenUp {};
  InParallel(count, poll, [&](int k, const std::function<void()>& poll_item) {
    const auto poll_or_give_up = [&] {
      poll_item();
      if (is_in_vain(k)) throw GivenUp();
    };
    try {
      if (!is_in_vain(k)) work(k, poll_or_give_up);
    } catch (const GivenUp&) {
    }
  });
}

/// The first k of 0..count-1 for which work(k, poll) returns true, else `count`. Those after it are tried
/// ahead on threads that are free, and given up by `poll`; they must write nothing that the result hangs on.
template <class Work>
int FirstThat(int count, const std::function<void()>& poll, const Work& work) {
  std::atomic<int> first{count};
  InParallelUnless([&](int k) { return k > first; }, count, poll,
                   [&](int k, const auto& poll_item) {
                     if (!work(k, poll_item)) return;
                     for (int known = first; k < known && !first.compare_exchange_weak(known, k);) {
                     }
                   });
  return first;
}

/// InParallel for k = 0..count-1, and, on threads that have nothing else to do meanwhile, for as many of
/// `ahead` more as they come to: one that is not done then is given up by `poll`.
template <class Work>
void InParallelWithAhead(int count, int ahead, const std::function<void()>& poll, const Work& work) {
  std::atomic<int> open{count};
  InParallelUnless([&](int k) { return k >= count && open == 0; }, count + ahead, poll,
                   [&](int k, const auto& poll_item) {
                     work(k, poll_item);
                     if (k < count) --open;
                   });
}

}  // namespace dcharts
