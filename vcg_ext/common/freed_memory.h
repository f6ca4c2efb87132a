// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdlib>

namespace dcharts {

/// Lets the C library keep some of the memory that is freed. Glibc gives the end of the heap back to the
/// system when more than twice the largest block that it ever freed is there, and takes it again page by page
/// for the next trial, which is 2 % of the time of a small mesh. Once so large a block was freed, as when a
/// large mesh was loaded, up to 48 MB stay. Other libraries don't mind.
inline void KeepFreedMemory() {
  constexpr std::size_t kBlock = 24 << 20;
  void* volatile block = std::malloc(kBlock);  // volatile: else nothing would be left of the two calls
  std::free(block);
}

}  // namespace dcharts
