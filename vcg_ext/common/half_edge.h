// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dcharts {

/// Half-edge h = 3 f + i is edge (i, i+1) of triangle f. The half-edge after / before `h` in its triangle.
inline int Next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline int Previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }

}  // namespace dcharts
