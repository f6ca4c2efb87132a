// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "random_case.h"

namespace dcharts::fuzz {

/// A filter, its parameters and a mesh of at most about 60 faces, as the bytes say: the first tells the
/// filter, then come parameters, vertices, faces and attributes, each with a count. Any bytes make a case.
RandomCase CaseFromBytes(const std::uint8_t* data, std::size_t size);

}  // namespace dcharts::fuzz
