#pragma once

#include <cstddef>

// Counts the heap allocations of the program. Include in one source file only, because it defines malloc.

namespace spring_workbench::test_support {
inline long allocations = 0;
}  // namespace spring_workbench::test_support

// All heap allocations use one of these, including Eigen's and operator new. Sanitizers define their own; clang does
// not say so.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define COUNTS_ALLOCATIONS 1
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* malloc(std::size_t size) {
  ++spring_workbench::test_support::allocations;
  return __libc_malloc(size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++spring_workbench::test_support::allocations;
  return __libc_memalign(alignment, size);
}
}
#else
#define COUNTS_ALLOCATIONS 0
#endif
