// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <string>

namespace dcharts::test {

/// Sets the number of threads, and puts it back.
class Threads {
 public:
  explicit Threads(int count) {
    const char* before = std::getenv(kName);
    before_ = before != nullptr ? before : "";
    Set(std::to_string(count));
  }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  ~Threads() { Set(before_); }

 private:
  static constexpr const char* kName = "OMP_NUM_THREADS";

  // Empty: not set, or of no meaning, which is the same.
  static void Set(const std::string& value) {
#ifdef _WIN32
    _putenv_s(kName, value.c_str());
#else
    setenv(kName, value.c_str(), 1);
#endif
  }

  std::string before_;
};

}  // namespace dcharts::test
