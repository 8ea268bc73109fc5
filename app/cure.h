// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "solver/core/result.h"

namespace geotherm::app {

/// The failure with a cure behind it, unless its sentence has one: "WHAT; CURE". What stands before
/// the end of `path` does not count, for a name may hold anything.
inline Error with_cure(Error error, const std::string& path, const std::string& cure) {
  const std::size_t named = error.message.find(path);
  const std::size_t begin = named == std::string::npos ? 0 : named + path.size();
  if (error.message.find("; ", begin) == std::string::npos) error.message += "; " + cure;
  return error;
}

}  // namespace geotherm::app
