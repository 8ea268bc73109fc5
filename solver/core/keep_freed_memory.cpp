// SPDX-License-Identifier: MIT
#include "solver/core/keep_freed_memory.h"

#include <cstdlib>  // says whether the C library is glibc

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace geotherm {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLargestBlock = 32 << 20;  // the most that glibc takes
  constexpr int kMaxKept = 512 << 20;
  if (mallopt(M_MMAP_THRESHOLD, kLargestBlock) == 0) return;
  mallopt(M_TRIM_THRESHOLD, kMaxKept);
#endif
}

void release_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace geotherm
