// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace dcharts {

/// Reports how far the work is, passes on log lines, and turns a callback that returns false into Cancelled.
/// Call it from one thread only.
class Progress {
 public:
  using Callback = std::function<bool(int percent, const char* text)>;
  using Logger = std::function<void(const std::string& line)>;

  explicit Progress(Callback callback = {}, Logger logger = {});

  /// A stage named `name` ("Growing charts...") begins; it takes the range [from, to] (0..1) of the whole
  /// work. Throws Cancelled.
  void BeginStage(const char* name, double from, double to);

  /// `fraction` (0..1) of the current stage is done; less than was done before changes nothing. Calls back
  /// only when the percentage moved. Throws Cancelled.
  void Update(double fraction);

  double Done() const { return done_; }  ///< the fraction of the current stage

  /// Asks whether to go on without moving the percentage. Throws Cancelled.
  void Poll();

  void Log(const std::string& line);

 private:
  void Call(int percent);

  Callback callback_;
  Logger logger_;
  std::string stage_;
  double from_ = 0, to_ = 1, done_ = 0;
  int percent_ = 0;
};

}  // namespace dcharts
