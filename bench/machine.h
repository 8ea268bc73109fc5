// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace geotherm::bench {

/// What the figures were measured on.
struct Machine {
  std::string cpu, blas, compiler;
  int cores = 0;
  double load = 0;  ///< of other programs when this was read: runnable threads, a minute's mean
};

Machine read_machine();

}  // namespace geotherm::bench
