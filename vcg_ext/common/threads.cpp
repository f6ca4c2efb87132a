// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/threads.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

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

// A spare thread that rests waits here for a helper to end.
std::mutex rest_mutex;
std::condition_variable helper_ended;
std::atomic<int> resting{0};

std::atomic<int> spares_at_work{0};

// This is a spare thread or a helper of one.
thread_local bool is_spare = false;

int MostHelpers() { return ThreadCount() - (is_spare ? 2 : 1); }

// How many of the helpers wanted are free; they are at work from now on.
int TakeHelpers(int wanted) {
  const int most = MostHelpers();
  int at_work = helpers_at_work;
  for (;;) {
    const int taken = std::min(wanted, most - at_work);
    if (taken <= 0) return 0;
    if (helpers_at_work.compare_exchange_weak(at_work, at_work + taken)) return taken;
  }
}

void ReturnHelpers(int count) {
  helpers_at_work -= count;
  if (resting > 0) helper_ended.notify_all();
}

// A thread's first exception needs memory of its own, and where there is none the C library ends the program.
// So each thread takes it before it is at work (`is_ready`), from what is let go of just before: so much that
// it comes from the system and goes back to it. Throws where the system gives no thread or has no memory.
template <class Work>
std::thread Started(const Work& work) {
  constexpr std::size_t kReserve = 40 << 20;
  std::atomic<bool> is_ready{false};
  ::operator delete(::operator new(kReserve));
  std::thread thread([&is_ready, work] {
    static_cast<void>(std::uncaught_exceptions());
    is_ready = true;
    work();
  });
  while (!is_ready) std::this_thread::yield();
  return thread;
}

}  // namespace

WaitsForHelpers::WaitsForHelpers() { ReturnHelpers(1); }

WaitsForHelpers::~WaitsForHelpers() { ++helpers_at_work; }

SpareThread::SpareThread(const std::function<void()>& work) {
  if (ThreadCount() < 2) return;
  ++spares_at_work;
  try {
    thread_ = Started([work] {
      is_spare = true;
      work();
      --spares_at_work;
    });
    return;
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  --spares_at_work;
}

SpareThread::~SpareThread() {
  if (thread_.joinable()) thread_.join();
}

void SpareThread::GiveWay(const std::atomic<bool>& is_over) {
  constexpr std::chrono::milliseconds kPatience(1);  // one that ends just now isn't heard
  if (helpers_at_work < ThreadCount() - 1) return;
  std::unique_lock<std::mutex> lock(rest_mutex);
  ++resting;
  while (!is_over && helpers_at_work >= ThreadCount() - 1) helper_ended.wait_for(lock, kPatience);
  --resting;
}

int FreeThreads() { return std::max(0, MostHelpers() - helpers_at_work); }

int IdleThreads() { return std::max(0, FreeThreads() - (is_spare ? 0 : spares_at_work.load())); }

Helpers::Helpers(int most, std::function<void()> work) : most_(most), work_(std::move(work)) { StartFree(); }

Helpers::~Helpers() {
  for (std::thread& thread : threads_) thread.join();
}

// Not OpenMP: where a thread can't be made, its library ends the program.
void Helpers::StartFree() {
  int free = TakeHelpers(most_ - static_cast<int>(threads_.size()));
  if (free == 0) return;
  try {
    threads_.reserve(static_cast<std::size_t>(most_));
    for (; free > 0; --free)
      threads_.push_back(Started([this, for_spare = is_spare] {
        is_spare = for_spare;
        work_();
        ReturnHelpers(1);
      }));
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  if (free > 0) ReturnHelpers(free);
}

}  // namespace dcharts
