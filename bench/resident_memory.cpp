// SPDX-License-Identifier: MIT
#include "bench/resident_memory.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "solver/core/memory.h"

namespace geotherm::bench {
namespace {

/// A line of /proc/self/status that holds kilobytes, in 2^20 bytes; 0 where there is none.
double status_megabytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(key)) continue;
    std::istringstream rest(line.substr(key.size()));
    double kilobytes = 0;
    rest >> kilobytes;
    return kilobytes / 1024;
  }
  return 0;
}

}  // namespace

PeakMemory::PeakMemory() {
  release_freed_memory();  // must not serve what is measured
  std::ofstream refs("/proc/self/clear_refs");
  if (refs << 5 << std::flush) before_ = status_megabytes("VmRSS:");  // the peak starts anew
}

double PeakMemory::megabytes() const { return std::max(0.0, status_megabytes("VmHWM:") - before_); }

}  // namespace geotherm::bench
