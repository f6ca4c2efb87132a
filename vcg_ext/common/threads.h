// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace dcharts {

/// How many threads a loop takes: the first number of the environment's OMP_NUM_THREADS, else as many as
/// there are cores. At least 1.
int ThreadCount();

/// How many helpers would be free now.
int FreeThreads();

/// How many of them no spare thread uses: for what may turn out to be in vain.
int IdleThreads();

/// Threads that help the one that made this with a work, until it has no more for them.
class Helpers {
 public:
  /// Starts up to `most`, each of which calls work(), which must not throw. There are fewer where more than
  /// ThreadCount() threads would be at work in all, as within such a work, and where the system gives fewer
  /// or has no memory for them.
  Helpers(int most, std::function<void()> work);
  ~Helpers();  ///< waits for their end
  Helpers(const Helpers&) = delete;

  /// Starts those as well that have become free since. For the thread that made this.
  void StartFree();

 private:
  const int most_;
  const std::function<void()> work_;
  std::vector<std::thread> threads_;
};

/// A thread for work that may wait, beside what Helpers do. It counts as at work only for helpers of its own,
/// so that it never takes a thread from others, but must call GiveWay() now and then.
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

/// While it lives, this thread only waits for its helpers: one of them may have a helper in its place.
class WaitsForHelpers {
 public:
  WaitsForHelpers();
  ~WaitsForHelpers();
  WaitsForHelpers(const WaitsForHelpers&) = delete;
  WaitsForHelpers& operator=(const WaitsForHelpers&) = delete;
};

}  // namespace dcharts
