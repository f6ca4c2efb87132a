// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/progress.h"

#include <algorithm>
#include <utility>

#include "common/errors.h"

namespace dcharts {

Progress::Progress(Callback callback, Logger logger)
    : callback_(std::move(callback)), logger_(std::move(logger)) {}

void Progress::BeginStage(const char* name, double from, double to) {
  stage_ = name;
  from_ = from;
  to_ = to;
  done_ = 0;
  Call(static_cast<int>(100 * from));
}

void Progress::Update(double fraction) {
  done_ = std::max(done_, std::min(fraction, 1.0));
  const double whole = from_ + (to_ - from_) * done_;
  const int percent = static_cast<int>(100 * whole);
  if (percent != percent_) Call(percent);
}

void Progress::Poll() { Call(percent_); }

void Progress::Log(const std::string& line) {
  if (logger_) logger_(line);
}

void Progress::Call(int percent) {
  percent_ = percent;
  if (callback_ && !callback_(percent, stage_.c_str())) throw Cancelled();
}

}  // namespace dcharts
