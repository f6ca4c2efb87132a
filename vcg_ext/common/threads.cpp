// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/threads.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
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

namespace {

// Those of all calls, one within another too. A helper counts until it has no more work, not until all have.
std::atomic<int> helpers_at_work{0};

// How many of the helpers wanted are free; they are at work from now on.
int TakeHelpers(int wanted) {
  const int most = ThreadCount() - 1;
  int at_work = helpers_at_work;
  for (;;) {
    const int taken = std::min(wanted, most - at_work);
    if (taken <= 0) return 0;
    if (helpers_at_work.compare_exchange_weak(at_work, at_work + taken)) return taken;
  }
}

// Starts threads and keeps them waiting until all there are have been started. A thread's first exception
// needs memory of its own, and where there is none the C library ends the program. So each thread takes it
// before any is at work, from what is let go of just before: so much that it comes from the system and goes
// back to it.
class HeldThreads {
 public:
  HeldThreads(int count, const std::function<void(bool)>& work) {
    constexpr std::size_t kReserve = 40 << 20;
    try {
      threads_.reserve(static_cast<std::size_t>(count));
      for (int k = 0; k < count; ++k) {
        ::operator delete(::operator new(kReserve));
        threads_.emplace_back([this, &work] {
          static_cast<void>(std::uncaught_exceptions());
          ++ready_;
          while (!go_) std::this_thread::yield();
          work(false);
          --helpers_at_work;
        });
        while (ready_ <= k) std::this_thread::yield();
      }
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
    helpers_at_work -= count - static_cast<int>(threads_.size());
    go_ = true;
  }
  HeldThreads(const HeldThreads&) = delete;
  HeldThreads& operator=(const HeldThreads&) = delete;
  ~HeldThreads() {
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  std::atomic<int> ready_{0};
  std::atomic<bool> go_{false};
  std::vector<std::thread> threads_;
};

}  // namespace

WaitsForHelpers::WaitsForHelpers() { --helpers_at_work; }

WaitsForHelpers::~WaitsForHelpers() { ++helpers_at_work; }

int FreeThreads() { return std::max(0, ThreadCount() - 1 - helpers_at_work); }

// Not OpenMP: where a thread can't be made, its library ends the program.
void OnThreads(int helpers, const std::function<void(bool)>& work) {
  const HeldThreads threads(TakeHelpers(helpers), work);
  work(true);
}

}  // namespace dcharts
