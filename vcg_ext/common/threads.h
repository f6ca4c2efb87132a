// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace dcharts {

/// How many threads a loop takes: the first number of the environment's OMP_NUM_THREADS, else as many as
/// there are cores. At least 1.
int ThreadCount();

/// How many helpers a call of OnThreads would get now.
int FreeThreads();

/// How many of them no spare thread uses: for what may turn out to be in vain.
int IdleThreads();

/// Calls work(true) on this thread and at the same time work(false) on `helpers` others. There are fewer
/// where more than ThreadCount() threads would be at work in all, as within such a call, and where the system
/// gives fewer or has no memory for them. Returns when all have ended; `work` must not throw.
void OnThreads(int helpers, const std::function<void(bool)>& work);

/// A thread for work that may wait, beside what OnThreads does. It counts as at work only for its own calls
/// of OnThreads, so that it never takes a thread from others, but must call GiveWay() now and then.
class SpareThread {
 public:
  /// Starts work(), which must not throw and outlives what it uses. Not where ThreadCount() is 1, nor where
  /// the system gives no thread or has no memory for it.
  explicit SpareThread(const std::function<void()>& work);
  ~SpareThread();  ///< waits for its end
  SpareThread(const SpareThread&) = delete;
  bool HasStarted() const { return thread_.joinable(); }

  /// For the work to call: returns when fewer than ThreadCount() threads are at work beside it, or `is_over`.
  static void GiveWay(const std::atomic<bool>& is_over);

 private:
  std::thread thread_;
};

/// While it lives, the thread that called OnThreads only waits for its helpers: one of them may have a helper
/// in its place.
class WaitsForHelpers {
 public:
  WaitsForHelpers();
  ~WaitsForHelpers();
  WaitsForHelpers(const WaitsForHelpers&) = delete;
  WaitsForHelpers& operator=(const WaitsForHelpers&) = delete;
};

}  // namespace dcharts
