// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "geotherm/error.h"

// Numbers to text and back, the same in every locale.
namespace geotherm::app {

/// 1234567 -> "1,234,567".
std::string grouped(std::int64_t number);

/// 4 significant digits unless said otherwise: "0.01235", "1.5", "3.2e-17", "inf".
std::string significant(double value, int digits = 4);

/// "1.50" for 2 decimals.
std::string fixed(double value, int decimals);

/// Three digits where they mean something: "0.412", "8.31", "34.5", "2,330".
std::string milliseconds(double value);

/// "1 vertex", "2,002 vertices".
std::string counted(std::int64_t number, std::string_view one, std::string_view many);

/// "a, b, c".
template <class Range>
std::string joined(const Range& parts, std::string_view between = ", ") {
  std::string text;
  for (const auto& part : parts) {
    if (!text.empty()) text += between;
    text += part;
  }
  return text;
}

std::string_view trimmed(std::string_view text);

/// The parts between the characters `at`: one more than there are of these.
std::vector<std::string_view> split(std::string_view text, char at);

/// The whole of `text` as a number, or nothing.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The whole of `text` as a count, in digits or as 2e6; nothing below 0 or beyond 2^53.
std::optional<std::int64_t> count_in(std::string_view text);

/// The text with line ends in place of some blanks: no line longer than `width` unless a word is.
std::string wrapped(const std::string& text, std::size_t width);

/// Fit for one line: what cannot be shown becomes '?' (solver/core/text.h).
std::string one_line(std::string_view text);

/// The same of at most 60 bytes: of a longer text the beginning and "...".
std::string shortened(std::string_view text);

/// Text for HTML, SVG and XML: &, <, > and double quotes as entities, and '?' for what these may
/// not hold (control characters, bytes that are no UTF-8).
std::string escaped(std::string_view text);

/// Rows of cells under headings, as lines of aligned columns.
class TextTable {
 public:
  enum class Align { kLeft, kRight };
  struct Column {
    std::string heading;
    Align align = Align::kLeft;
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Precondition: one cell a column.
  void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  /// The heading (unless all are empty), then the rows; two spaces between columns.
  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// A command on one line of UTF-8 as it can be given to a shell (bash, zsh) again: words quoted
/// where they need it, control characters and bytes that are no UTF-8 as $'\012'.
std::string shell_command(std::string program, const std::vector<std::string>& words);

/// kBadInput: "'TEXT' WHY", and what to do in its hint.
Error bad_value(const std::string& text, const std::string& why, const std::string& hint = {});

}  // namespace geotherm::app
