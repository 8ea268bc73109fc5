// SPDX-License-Identifier: MIT
#include "app/machine.h"

#include <sys/resource.h>

#include <fstream>

#include "app/text.h"
#include "solver/core/parallel.h"
#include "solver/linear/blas_threads.h"

namespace geotherm::app {
namespace {

/// What follows "key...:" in a file of /proc; empty when there is no such line.
std::string proc_value(const char* file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos || !line.starts_with(key)) continue;
    return std::string(trimmed(std::string_view(line).substr(colon + 1)));
  }
  return {};
}

}  // namespace

Machine this_machine() {
  std::string cpu = proc_value("/proc/cpuinfo", "model name");
  if (cpu.empty()) cpu = proc_value("/proc/cpuinfo", "Model");
  if (cpu.empty()) cpu = "unknown";
  return {std::move(cpu), thread_count(0), blas_name()};
}

double peak_rss_mb() {
  // "VmHWM:  12345 kB" follows reset_peak_rss(); getrusage() is there everywhere.
  const std::string peak = proc_value("/proc/self/status", "VmHWM");
  if (const auto kilobytes = number_in<double>(peak.substr(0, peak.find(' ')))) {
    return *kilobytes / 1024;
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void reset_peak_rss() { std::ofstream("/proc/self/clear_refs") << "5"; }

}  // namespace geotherm::app
