// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace geotherm::bench {

/// How much more memory the process had at its peak than when this was made, in 2^20 bytes.
/// 0 where the system does not tell, or lets no peak begin anew.
class PeakMemory {
 public:
  PeakMemory();
  double megabytes() const;

 private:
  double before_ = std::numeric_limits<double>::infinity();
};

}  // namespace geotherm::bench
