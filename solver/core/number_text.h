// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>

namespace geotherm {

/// The shortest text that reads back as the same number; independent of the locale.
inline std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

/// "1 byte", "2 bytes".
inline std::string counted_text(std::size_t number, const char* one, const char* many) {
  return std::to_string(number) + ' ' + (number == 1 ? one : many);
}

/// The number to three significant digits, for messages.
inline std::string rounded_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::general, 3)
                       .ptr;
  return {buffer.data(), end};
}

}  // namespace geotherm
