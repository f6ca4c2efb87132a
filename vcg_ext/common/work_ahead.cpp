// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/work_ahead.h"

#include <chrono>

#include "common/errors.h"

namespace dcharts {

WorkAhead::~WorkAhead() { is_given_up_ = true; }

void WorkAhead::Begin() {
  if (thread_) return;
  thread_.emplace([this] { Work(); });
  if (!thread_->HasStarted()) thread_.reset();
}

Poll WorkAhead::BeginningAfter(std::chrono::milliseconds patience, const Poll& poll) {
  return [this, poll, begin = std::chrono::steady_clock::now() + patience] {
    if (poll) poll();
    if (std::chrono::steady_clock::now() > begin && IdleThreads() > 0) Begin();
  };
}

void WorkAhead::Finish(std::size_t count, const Poll& poll) {
  if (!thread_) {
    for (; done_ < count; ++done_) steps_[done_](poll);
    return;
  }
  const WaitsForHelpers waits;
  std::unique_lock<std::mutex> lock(mutex_);
  while (done_ < count && !failure_) {
    lock.unlock();
    if (poll) poll();
    lock.lock();
    changed_.wait_for(lock, std::chrono::milliseconds(1));
  }
  if (done_ < count) std::rethrow_exception(failure_);
}

void WorkAhead::Work() {
  try {
    const Poll poll = [this] {
      SpareThread::GiveWay(is_given_up_);
      if (is_given_up_) throw Cancelled();
    };
    for (const Step& step : steps_) {
      step(poll);
      const std::lock_guard<std::mutex> lock(mutex_);
      ++done_;
      changed_.notify_one();
    }
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = std::current_exception();
    changed_.notify_one();
  }
}

}  // namespace dcharts
