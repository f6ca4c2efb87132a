// SPDX-License-Identifier: GPL-3.0-or-later
/// The program's operator new, and what the linker puts in the place of malloc, calloc and realloc.
#include "failing_memory.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> g_counts{false};
std::atomic<long> g_count{0}, g_failing{0};

bool Fails() { return g_counts && ++g_count == g_failing; }

}  // namespace

namespace dcharts::test {

void StartCounting(long failing) {
  g_count = 0;
  g_failing = failing;
  g_counts = true;
}

long StopCounting() {
  g_counts = false;
  return g_count;
}

}  // namespace dcharts::test

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* old, std::size_t size);
void* __wrap_malloc(std::size_t size);
void* __wrap_calloc(std::size_t count, std::size_t size);
void* __wrap_realloc(void* old, std::size_t size);

void* __wrap_malloc(std::size_t size) { return Fails() ? nullptr : __real_malloc(size); }
void* __wrap_calloc(std::size_t count, std::size_t size) {
  return Fails() ? nullptr : __real_calloc(count, size);
}
void* __wrap_realloc(void* old, std::size_t size) { return Fails() ? nullptr : __real_realloc(old, size); }
}

void* operator new(std::size_t size) {
  void* memory = Fails() ? nullptr : __real_malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
