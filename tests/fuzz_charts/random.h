// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include <Eigen/Core>

namespace dcharts::fuzz {

/// Random numbers that are the same everywhere: the standard's distributions differ between libraries, its
/// engines don't.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double Real(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int Int(int low, int high) {  // both included
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  std::size_t Index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }  // count > 0
  double Log(double low, double high) { return std::exp(Real(std::log(low), std::log(high))); }
  bool Chance(double probability) { return Real(0, 1) < probability; }
  Eigen::Vector3d Vector() { return {Real(-1, 1), Real(-1, 1), Real(-1, 1)}; }

  /// One of these.
  template <class Choices>
  auto Of(const Choices& choices) {
    return choices[Index(std::size(choices))];
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace dcharts::fuzz
