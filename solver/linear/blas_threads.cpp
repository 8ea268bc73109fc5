// SPDX-License-Identifier: MIT
#include "solver/linear/blas_threads.h"

#include <mutex>

// Weak: with another BLAS these are absent and nothing is set.
extern "C" {
__attribute__((weak)) void openblas_set_num_threads(int threads);
__attribute__((weak)) int openblas_get_num_threads(void);
}

namespace geotherm {
namespace {

std::mutex& guard() {
  static std::mutex mutex;
  return mutex;
}
int users = 0;      // guarded
int before_us = 1;  // guarded

bool adjustable() {
  return openblas_set_num_threads != nullptr && openblas_get_num_threads != nullptr;
}

}  // namespace

BlasThreads::BlasThreads(int threads) {
  const std::lock_guard lock(guard());
  if (!adjustable()) return;
  if (users++ == 0) before_us = openblas_get_num_threads();
  openblas_set_num_threads(threads);
}

BlasThreads::~BlasThreads() {
  const std::lock_guard lock(guard());
  if (!adjustable()) return;
  if (--users == 0) openblas_set_num_threads(before_us);
}

}  // namespace geotherm
