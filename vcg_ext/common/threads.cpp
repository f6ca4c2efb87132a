// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/threads.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace dcharts {

int ThreadCount() {
  constexpr long kMost = 1024;
  const char* wanted = std::getenv("OMP_NUM_THREADS");
  const long number = wanted != nullptr ? std::strtol(wanted, nullptr, 10) : 0;
  if (number > 0) return static_cast<int>(std::min(number, kMost));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Not OpenMP: where a thread can't be made, its library ends the program.
void OnThreads(int helpers, const std::function<void(bool)>& work) {
  std::vector<std::thread> threads;
  try {
    threads.reserve(static_cast<std::size_t>(std::max(0, helpers)));
    for (int k = 0; k < helpers; ++k) threads.emplace_back([&work] { work(false); });
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  work(true);
  for (std::thread& thread : threads) thread.join();
}

}  // namespace dcharts
