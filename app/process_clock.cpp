// SPDX-License-Identifier: MIT
#include "app/process_clock.h"

#include <time.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace geotherm::app {

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
