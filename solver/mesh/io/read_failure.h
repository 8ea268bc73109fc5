// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "geotherm/error.h"

namespace geotherm::io {

/// Thrown and caught inside the readers only; read_mesh() makes an Error of it, with the path.
struct ReadFailure {
  std::string message;   ///< "line N: cause", "byte N: cause", or the cause alone
  std::size_t line = 0;  ///< N where it is a line
  std::string cause = {};
  Hint hint = {};
};

/// Throws "line N: cause" for the place `where` inside `text`.
[[noreturn]] void fail_at_line(std::string_view text, const char* where, const std::string& cause,
                               Hint hint = {});

/// Throws "byte N: cause", N counted from 0.
[[noreturn]] void fail_at_byte(std::string_view bytes, const char* where, const std::string& cause,
                               Hint hint = {});

/// The word at `where` in quotes, shortened, only printable characters: fit for a message.
std::string quoted(std::string_view text, const char* where);

}  // namespace geotherm::io
