// SPDX-License-Identifier: MIT
#include "bench/machine.h"

#include <cstdlib>
#include <fstream>

#include "solver/core/parallel.h"

// Weak: with another BLAS it is absent.
extern "C" {
__attribute__((weak)) char* openblas_get_config(void);
}

namespace geotherm::bench {
namespace {

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
    if (begin != std::string::npos) return line.substr(begin);
  }
  return "unknown";
}

std::string blas_name() {
  if (openblas_get_config == nullptr) return "unknown";
  std::string config = openblas_get_config();
  while (!config.empty() && config.back() == ' ') config.pop_back();
  return config;
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

Machine read_machine() {
  Machine machine{.cpu = cpu_name(),
                  .blas = blas_name(),
                  .compiler = compiler_name(),
                  .cores = thread_count(0)};
  if (getloadavg(&machine.load, 1) != 1) machine.load = 0;
  return machine;
}

}  // namespace geotherm::bench
