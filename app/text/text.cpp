// SPDX-License-Identifier: MIT
#include "app/text/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "solver/core/text.h"

namespace geotherm::app {

Error bad_value(const std::string& text, const std::string& why, const std::string& hint) {
  return {ErrorCode::kBadInput, "'" + one_line(text) + "' " + why,
          hint.empty() ? Hint() : Hint{hint}};
}

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

std::string significant(double value, int digits) { return rounded_text(value, digits); }

std::string milliseconds(double value) {
  if (!std::isfinite(value)) return significant(value);
  if (value == 0 || value >= 99.95) return grouped(std::llround(value));
  return fixed(value, value < 0.9995 ? 3 : value < 9.995 ? 2 : 1);
}

std::string counted(std::int64_t number, std::string_view one, std::string_view many) {
  return grouped(number) + " " + std::string(number == 1 ? one : many);
}

std::optional<std::int64_t> count_in(std::string_view text) {
  constexpr double kMax = 9007199254740992.0;  // up to here doubles are exact
  const auto number = number_in<double>(text);
  if (!number || !(*number >= 0 && *number <= kMax) || *number != std::floor(*number)) return {};
  return static_cast<std::int64_t>(*number);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n\f\v";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(at, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
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

std::string shortened(std::string_view text) {
  constexpr std::size_t kShown = 60;
  if (text.size() <= kShown) return one_line(text);
  return one_line(text.substr(0, kShown - 3)) + "...";
}

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

namespace {

/// Characters shown: bytes but for the later ones of a UTF-8 sequence.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

}  // namespace

std::string TextTable::text() const {
  std::vector<std::vector<std::string>> lines;
  std::vector<std::string> headings;
  for (const Column& column : columns_) headings.push_back(column.heading);
  const bool headed = std::any_of(headings.begin(), headings.end(),
                                  [](const std::string& heading) { return !heading.empty(); });
  if (headed) lines.push_back(headings);
  lines.insert(lines.end(), rows_.begin(), rows_.end());

  std::vector<std::size_t> widths(columns_.size(), 0);
  for (const auto& cells : lines) {
    for (std::size_t c = 0; c < columns_.size(); ++c)
      widths[c] = std::max(widths[c], width(cells[c]));
  }
  std::string out;
  for (const auto& cells : lines) {
    std::string line;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::string space(widths[c] - width(cells[c]), ' ');
      if (c > 0) line += "  ";
      line += columns_[c].align == Align::kLeft ? cells[c] + space : space + cells[c];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out;
}

namespace {

constexpr std::string_view kUnquoted =
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
    const bool plain = !word.empty() && word.find_first_not_of(kUnquoted) == std::string::npos;
    if (plain && word[0] != '=') {  // which zsh takes for a program's path
      program += word;
    } else {
      program += fits_a_line(word) ? in_quotes(word) : in_dollar_quotes(word);
    }
  }
  return program;
}

}  // namespace geotherm::app
