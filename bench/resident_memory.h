// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::bench {

/// How much more memory the process had at its peak than when this was made, in 2^20 bytes.
/// Linux only; 0 elsewhere.
class PeakMemory {
 public:
  PeakMemory();
  double megabytes() const;

 private:
  double before_ = 0;
};

}  // namespace geotherm::bench
