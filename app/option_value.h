// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "app/told.h"
#include "solver/core/result.h"

// What turns the words of a command line into values, or into one line that says what is wrong.
namespace geotherm::app {

/// Stores the value of a parsed option, or says which option was wrong.
template <class Value, class Into>
Result<void> take(Result<Value> parsed, std::string_view option, Into& into) {
  if (!parsed) {
    return about(std::string(option), parsed.error());
  }
  into = *std::move(parsed);
  return {};
}

/// The first failure of several.
inline Result<void> first_failure(std::initializer_list<Result<void>> all) {
  for (const Result<void>& each : all) {
    if (!each) return each;
  }
  return {};
}

}  // namespace geotherm::app
