// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace geotherm {

/// While any of these lives, OpenBLAS (where it is the BLAS) uses `threads` threads a call; the
/// last one to go restores what the process had. With one thread, OpenMP regions entered by the
/// calling thread (CHOLMOD has some) run on that thread alone. Factorisations that run side by side
/// would otherwise each start a full team and wait for each other.
class BlasThreads {
 public:
  explicit BlasThreads(int threads);
  ~BlasThreads();

  /// Whether address space is left for the buffers of the BLAS and for so many bytes beside them;
  /// on one thread, where it is not for all. OpenBLAS waits for its buffers for ever instead of
  /// failing.
  bool has_room(std::int64_t bytes_beside);

  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  int threads_;
  int buffers_ = 0;             ///< that are there when this ends
  int omp_levels_before_ = -1;  ///< -1: not touched
};

/// Name, version and chosen kernel set of the BLAS this build is linked with, for reports; "none"
/// when there is no BLAS.
std::string blas_name();

}  // namespace geotherm
