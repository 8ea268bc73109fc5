// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm {

/// While any of these lives, OpenBLAS (where it is the BLAS) uses `threads` threads a call; the
/// last one to go restores what the process had. Factorisations that run side by side would
/// otherwise each start a full team.
class BlasThreads {
 public:
  explicit BlasThreads(int threads);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;
};

}  // namespace geotherm
