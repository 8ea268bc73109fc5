// SPDX-License-Identifier: MIT
#include "app/shell_command.h"

#include <string_view>

#include "solver/core/text.h"

namespace geotherm::app {
namespace {

constexpr std::string_view kPlain =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";

bool fits_a_line(std::string_view word) { return printable(word) == word; }

std::string in_quotes(std::string_view word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + '\'';
}

/// With every byte but plain ASCII in octal digits.
std::string in_dollar_quotes(std::string_view word) {
  std::string out = "$'";
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\'' || c == '\\') {
      out += {'\\', c};
    } else if (byte >= ' ' && byte < 0x7f) {
      out += c;
    } else {
      constexpr std::string_view kDigits = "01234567";
      out += {'\\', kDigits[byte >> 6U], kDigits[byte >> 3U & 7U], kDigits[byte & 7U]};
    }
  }
  return out + '\'';
}

}  // namespace

std::string shell_command(std::string program, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    program += ' ';
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      program += word;
    } else {
      program += fits_a_line(word) ? in_quotes(word) : in_dollar_quotes(word);
    }
  }
  return program;
}

}  // namespace geotherm::app
