// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dcharts {

/// A pattern is sewn or glued along every dart, so it gets only those that its charts need to keep within
/// their bound.
enum class ChartsFor { kAtlas, kPattern };

}  // namespace dcharts
