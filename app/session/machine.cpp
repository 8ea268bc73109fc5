// SPDX-License-Identifier: MIT
#include "app/session/machine.h"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

#include "app/text/text.h"
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

double process_milliseconds() {
  // /proc/self/stat: the 20th number behind the name is the start in clock ticks since boot.
  std::ifstream file("/proc/self/stat");
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream fields(text.substr(name_end + 2));
  constexpr int kStart = 20;
  std::string field;
  for (int i = 0; i < kStart && fields >> field; ++i) {
  }
  timespec now{};
  if (!fields || ::clock_gettime(CLOCK_BOOTTIME, &now) != 0) return 0;
  const double start = std::stod(field) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  const double since = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  return 1e3 * (since - start);
}

}  // namespace geotherm::app
