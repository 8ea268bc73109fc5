// SPDX-License-Identifier: MIT
#pragma once

#include <geotherm/error.h>

#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>

/// What the examples do with errors: the value, or what went wrong and the end of the program.
template <class T>
T require(geotherm::Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "%s\n", sentence(result.error()).c_str());
    std::exit(EXIT_FAILURE);
  }
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}
