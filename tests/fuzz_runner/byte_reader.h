// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace dcharts::fuzz {

/// Takes bytes one after the other. Beyond the end there are zeros, so that any bytes are an input.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool AtEnd() const { return left_ == 0; }

  std::uint8_t Byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  int Int(int low, int high) {  // both included, at most 256 values
    return low + Byte() % (high - low + 1);
  }
  std::int8_t Signed() { return static_cast<std::int8_t>(Byte()); }

  /// Any double there is.
  double AnyDouble() {
    std::uint8_t bytes[sizeof(double)];
    for (std::uint8_t& byte : bytes) byte = Byte();
    double value = 0;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
  }

  /// One of these.
  template <class Choices>
  auto Of(const Choices& choices) {
    return choices[Byte() % std::size(choices)];
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace dcharts::fuzz
