// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "random_case.h"

namespace dcharts::fuzz {

struct Outcome {
  std::string refusal;  ///< the sentence, or empty
  std::string wrong;    ///< a line for each promise that was broken; empty when all is well
};

/// Runs a case as a host does and checks what is promised. A pattern's file is written into the working
/// directory, and removed.
Outcome RunCase(const RandomCase& what);

}  // namespace dcharts::fuzz
