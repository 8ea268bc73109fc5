// SPDX-License-Identifier: MIT
#include "solver/linear/blas_threads.h"

#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <mutex>

// Weak: with another BLAS these are absent and nothing is set.
extern "C" {
__attribute__((weak)) void openblas_set_num_threads(int threads);
__attribute__((weak)) int openblas_get_num_threads(void);
__attribute__((weak)) char* openblas_get_config(void);
__attribute__((weak)) char* openblas_get_corename(void);
__attribute__((weak)) void dgemm_(void);
__attribute__((weak)) void omp_set_max_active_levels(int levels);
__attribute__((weak)) int omp_get_max_active_levels(void);
}

namespace geotherm {
namespace {

std::mutex& guard() {
  static std::mutex mutex;
  return mutex;
}
int users = 0;      // guarded
int before_us = 1;  // guarded
int buffers = 0;    // guarded; that OpenBLAS surely has: it keeps them

/// What OpenBLAS maps for each thread that works (BUFFER_SIZE of x86-64; less elsewhere).
constexpr std::size_t kBufferBytes = std::size_t{128} << 20;

bool can_map(std::size_t bytes) {
  constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
  void* const place = ::mmap(nullptr, bytes, PROT_NONE, kFlags, -1, 0);
  if (place == MAP_FAILED) return false;
  ::munmap(place, bytes);
  return true;
}

bool adjustable() {
  return openblas_set_num_threads != nullptr && openblas_get_num_threads != nullptr;
}

}  // namespace

BlasThreads::BlasThreads(int threads) : threads_(threads) {
  if (threads == 1 && omp_set_max_active_levels != nullptr &&
      omp_get_max_active_levels != nullptr) {
    omp_levels_before_ = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
  }
  const std::lock_guard lock(guard());
  if (!adjustable()) return;
  if (users++ == 0) before_us = openblas_get_num_threads();
  openblas_set_num_threads(threads);
}

BlasThreads::~BlasThreads() {
  if (omp_levels_before_ >= 0) omp_set_max_active_levels(omp_levels_before_);
  const std::lock_guard lock(guard());
  if (!adjustable()) return;
  buffers = std::max(buffers, buffers_);
  if (--users == 0) openblas_set_num_threads(before_us);
}

bool BlasThreads::has_room(std::int64_t bytes_beside) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return true;
  const std::lock_guard lock(guard());
  if (!adjustable()) return true;
  for (const int threads : {threads_, 1}) {
    // Each of those that work at the same time may be about to ask for a buffer of its own.
    const int missing = std::max(users - 1 + threads - buffers, 0);
    const std::size_t bytes = static_cast<std::size_t>(missing) * kBufferBytes;
    if (!can_map(bytes + static_cast<std::size_t>(bytes_beside) + 1)) continue;
    if (threads < threads_) openblas_set_num_threads(threads);
    buffers_ = threads;
    return true;
  }
  return false;
}

std::string blas_name() {
  if (openblas_get_config == nullptr) return dgemm_ == nullptr ? "none" : "unknown BLAS";
  // "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH ...": the first two words name it.
  const std::string config = openblas_get_config();
  std::string name = config.substr(0, config.find(' ', config.find(' ') + 1));
  if (openblas_get_corename != nullptr) {
    name += std::string(" (") + openblas_get_corename() + ")";
  }
  return name;
}

}  // namespace geotherm
