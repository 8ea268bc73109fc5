// SPDX-License-Identifier: MIT
// Numbers, names of files and what is found in files, as text that people are shown.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace geotherm {

/// The shortest text that reads back as the same number; independent of the locale.
template <class Number>
std::string number_text(Number value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

/// The text with small letters for A to Z.
inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

/// "1 byte", "2 bytes".
inline std::string counted_text(std::size_t number, const char* one, const char* many) {
  return std::to_string(number) + ' ' + (number == 1 ? one : many);
}

/// The number to so many significant digits, for messages.
inline std::string rounded_text(double value, int digits = 3) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::general, digits)
                       .ptr;
  return {buffer.data(), end};
}

/// Bytes of the character at the front of a text in UTF-8 where it can be shown on a line; 0 where
/// it cannot: a control character (U+0000-U+001F, U+007F-U+009F), one that ends lines or turns
/// their direction (U+2028-U+202E, U+2066-U+2069), a noncharacter (U+FFFE, U+FFFF), or bytes that
/// are no UTF-8.
std::size_t printable_length(std::string_view text);

/// The text with '?' for each byte that cannot be shown: one line of UTF-8, whatever it was.
std::string printable(std::string_view text);

/// What to give in place of a word that is none of `known`: "there are bunny, cube", after
/// "did you mean bunny?" where one of them is near: letters changed, added, left out or swapped
/// with their neighbour (Damerau 1964), at most one in three and three in all.
std::string known_words(std::string_view word, const std::vector<std::string>& known);
/// The near one alone; empty where none is.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace geotherm

namespace geotherm::io {

/// The extension in lower case with its point (".obj"), or nothing; of the last part of the path.
inline std::string file_extension(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash != path.npos) path.remove_prefix(slash + 1);
  const std::size_t point = path.rfind('.');
  return lower_case(point == path.npos ? "" : path.substr(point));
}

/// The extension of the format in which a path is written: that of CSV for "-".
inline std::string written_extension(std::string_view path) {
  return path == "-" ? ".csv" : file_extension(path);
}

/// The path fit for a message of one line.
using geotherm::printable;

}  // namespace geotherm::io
