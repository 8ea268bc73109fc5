// SPDX-License-Identifier: MIT
#pragma once

#include <geotherm/error.h>

#include <cstdio>

/// What an example does with an error.
inline int fail(const geotherm::Error& error) {
  std::fprintf(stderr, "%s\n", geotherm::sentence(error).c_str());
  return 1;
}
