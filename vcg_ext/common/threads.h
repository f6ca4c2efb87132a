// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace dcharts {

/// How many threads a loop takes: the first number of the environment's OMP_NUM_THREADS, else as many as
/// there are cores. At least 1.
int ThreadCount();

/// How many helpers a call of OnThreads would get now.
int FreeThreads();

/// Calls work(true) on this thread and at the same time work(false) on `helpers` others. There are fewer
/// where more than ThreadCount() threads would be at work in all, as within such a call, and where the system
/// gives fewer or has no memory for them. Returns when all have ended; `work` must not throw.
void OnThreads(int helpers, const std::function<void(bool)>& work);

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
