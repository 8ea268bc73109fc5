// SPDX-License-Identifier: MIT
#include "solver/linear/blas_threads.h"

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

bool adjustable() {
  return openblas_set_num_threads != nullptr && openblas_get_num_threads != nullptr;
}

}  // namespace

BlasThreads::BlasThreads(int threads) {
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
  if (--users == 0) openblas_set_num_threads(before_us);
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
