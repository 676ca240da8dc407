#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

/// Counts what the program allocates; to be included in one file of it.
namespace sightline::bench {

inline std::size_t allocations = 0;

}  // namespace sightline::bench

// Not inlined: the compiler would take malloc and delete for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++sightline::bench::allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
