// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace geotherm::app {

struct Machine {
  std::string cpu;  ///< the processor's name, "unknown" where the system does not tell
  int cores = 1;
  std::string blas;  ///< what the direct backends compute with
};
Machine this_machine();

/// Largest resident memory of the process so far, in 2^20 bytes.
double peak_rss_mb();

/// Starts a new peak of resident memory, where the system permits it (Linux:
/// /proc/self/clear_refs); otherwise the peak stays that of the process.
void reset_peak_rss();

/// Wall time since the system started this process, milliseconds; 0 where it does not say.
double process_milliseconds();

}  // namespace geotherm::app
