// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dcharts::test {

/// Counts the allocations from here on, of all threads. The one numbered `failing`, from 1, finds no memory;
/// 0: none does.
void StartCounting(long failing);

/// How many there were. From here on all find memory.
long StopCounting();

}  // namespace dcharts::test
