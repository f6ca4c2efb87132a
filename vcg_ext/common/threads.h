// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace dcharts {

/// How many threads a loop takes: the first number of the environment's OMP_NUM_THREADS, else as many as
/// there are cores. At least 1.
int ThreadCount();

/// Calls work(true) on this thread and at the same time work(false) on `helpers` others. Where the system
/// gives fewer threads, or has no memory for them, there are fewer. Returns when all have ended; `work` must
/// not throw.
void OnThreads(int helpers, const std::function<void(bool)>& work);

}  // namespace dcharts
