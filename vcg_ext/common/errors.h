// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace dcharts {

/// What a user is told when a filter can't do its work: one sentence that says what is wrong and what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The host's progress callback returned false.
class Cancelled : public Error {
 public:
  Cancelled() : Error("Cancelled. The mesh was not changed.") {}
};

}  // namespace dcharts
