// SPDX-License-Identifier: MIT
#include "app/text.h"

#include <array>
#include <cmath>

#include "solver/core/text.h"

namespace geotherm::app {

std::string fixed(double value, int decimals) {
  std::array<char, 400> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  return {buffer.data(), end};
}

std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number);
  const std::size_t first = number < 0 ? 1 : 0;
  for (std::size_t i = digits.size(); i > first + 3;) digits.insert(i -= 3, 1, ',');
  return digits;
}

std::string significant(double value, int digits) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::general, digits)
                       .ptr;
  return {buffer.data(), end};
}

std::string milliseconds(double value) {
  if (!std::isfinite(value)) return significant(value);
  if (value == 0 || value >= 99.95) return grouped(std::llround(value));
  return fixed(value, value < 0.9995 ? 3 : value < 9.995 ? 2 : 1);
}

std::string counted(std::int64_t number, std::string_view one, std::string_view many) {
  return grouped(number) + " " + std::string(number == 1 ? one : many);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n\f\v";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::string out = text;
  std::size_t line = 0;   // where the current one begins
  std::size_t blank = 0;  // the last one seen in it
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i] == ' ') blank = i;
    if (i - line < width || blank <= line) continue;
    out[blank] = '\n';
    line = blank + 1;
  }
  return out;
}

std::string one_line(std::string_view text) { return printable(text); }

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace geotherm::app
