// SPDX-License-Identifier: MIT
#include "solver/mesh/io/read_failure.h"

#include <algorithm>
#include <utility>

namespace geotherm::io {

void fail_at_line(std::string_view text, const char* where, const std::string& cause, Hint hint) {
  const auto line = static_cast<std::size_t>(1 + std::count(text.data(), where, '\n'));
  throw ReadFailure{"line " + std::to_string(line) + ": " + cause, line, cause, std::move(hint)};
}

void fail_at_byte(std::string_view bytes, const char* where, const std::string& cause, Hint hint) {
  throw ReadFailure{
      "byte " + std::to_string(where - bytes.data()) + ": " + cause, 0, {}, std::move(hint)};
}

std::string quoted(std::string_view text, const char* where) {
  constexpr std::size_t kMax = 24;
  std::string word = "\"";
  for (const char* end = text.data() + text.size(); where < end; ++where) {
    const auto c = static_cast<unsigned char>(*where);
    if (c == ' ' || (c >= '\t' && c <= '\r')) break;
    if (word.size() > kMax) {
      word += "...";
      break;
    }
    word += c > ' ' && c < 0x7f ? *where : '?';
  }
  return word + "\"";
}

}  // namespace geotherm::io
