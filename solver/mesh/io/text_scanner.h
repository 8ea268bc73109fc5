// SPDX-License-Identifier: MIT
// Numbers from text that is followed by at least 8 readable bytes, the first of them no digit
// (FileBytes's padding). Independent of the locale.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "geotherm/error.h"

namespace geotherm::io {

inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

/// The number of digits at `p`, at most 8, and their value.
struct Digits {
  std::uint64_t value;
  int count;
};

/// Reads up to 8 digits at once (little endian: all in one register).
inline Digits read_digits(const char* p) {
  if constexpr (std::endian::native == std::endian::little) {
    std::uint64_t bytes;
    std::memcpy(&bytes, p, sizeof bytes);
    bytes ^= 0x3030303030303030u;  // digits become 0 to 9, everything else is larger
    const std::uint64_t others =
        (((bytes & 0x7f7f7f7f7f7f7f7fu) + 0x7676767676767676u) | bytes) & 0x8080808080808080u;
    const int count = std::countr_zero(others) / 8;
    if (count == 0) return {0, 0};
    bytes <<= 64 - 8 * count;  // leading zeros in front
    bytes = bytes * 10 + (bytes >> 8);
    const std::uint64_t value = ((bytes & 0x000000ff000000ffu) * 0x000f424000000064u +
                                 ((bytes >> 16) & 0x000000ff000000ffu) * 0x0000271000000001u) >>
                                32;
    return {value & 0xffffffffu, count};
  } else {
    Digits digits{0, 0};
    while (digits.count < 8 && is_digit(p[digits.count])) {
      digits.value = digits.value * 10 + static_cast<std::uint64_t>(p[digits.count++] - '0');
    }
    return digits;
  }
}

/// Reads all digits at `p` behind those already in `value`; wraps around beyond 19 digits.
inline const char* append_digits(const char* p, std::uint64_t& value) {
  static constexpr std::array<std::uint64_t, 9> kPowers = {
      1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
  Digits digits;
  do {
    digits = read_digits(p);
    value = value * kPowers[static_cast<std::size_t>(digits.count)] + digits.value;
    p += digits.count;
  } while (digits.count == 8);
  return p;
}

/// Reads a whole number with an optional sign. Returns the end, or null when there is none or it
/// has more than 18 digits.
inline const char* parse_integer(const char* p, std::int64_t& value) {
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  std::uint64_t magnitude = 0;
  const char* const end = append_digits(p, magnitude);
  if (end == p || end - p > 18) return nullptr;
  value = negative ? -static_cast<std::int64_t>(magnitude) : static_cast<std::int64_t>(magnitude);
  return end;
}

/// What parse_double() does not decide itself: many digits, large exponents, `inf`, `nan`.
const char* parse_double_slow(const char* p, double& value);

/// The double nearest to mantissa * 10^exponent; false when it takes the slow way to tell.
inline bool scale_decimal(std::uint64_t mantissa, int exponent, double& value) {
  static constexpr std::array<double, 23> kPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  if (exponent < -22 || exponent > 22) return false;
  const auto power = static_cast<std::size_t>(exponent < 0 ? -exponent : exponent);
  if (mantissa <= std::uint64_t{1} << 53) {  // both factors exact: one rounding (Clinger 1990)
    const auto whole = static_cast<double>(mantissa);
    value = exponent < 0 ? whole / kPowers[power] : whole * kPowers[power];
    return true;
  }
  if constexpr (std::numeric_limits<long double>::digits == 64 &&
                std::endian::native == std::endian::little) {
    // Exact factors again, rounded to 64 bits and then to 53. The second rounding can only err when
    // the first ended exactly half-way between two doubles.
    const auto whole = static_cast<long double>(mantissa);
    const auto factor = static_cast<long double>(kPowers[power]);
    const long double product = exponent < 0 ? whole / factor : whole * factor;
    std::uint64_t bits;
    std::memcpy(&bits, &product, sizeof bits);
    value = static_cast<double>(product);
    return (bits & 0x7ff) != 0x400;
  }
  return false;
}

/// Reads a decimal number, correctly rounded. Returns the end, or null when there is none. `inf`,
/// `nan` and numbers too large give a value that is not finite.
inline const char* parse_double(const char* p, double& value) {
  const char* const start = p;
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  std::uint64_t mantissa = 0;
  const char* const whole = p;
  while (is_digit(*p)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
  std::int64_t digits = p - whole;
  std::int64_t exponent = 0;
  if (*p == '.') {
    const char* const fraction = ++p;
    p = append_digits(p, mantissa);
    exponent = fraction - p;
    digits -= exponent;
  }
  if (digits == 0 || digits > 19) return parse_double_slow(start, value);
  if (*p == 'e' || *p == 'E') {
    std::int64_t written = 0;
    p = parse_integer(p + 1, written);
    if (p == nullptr || written < -999 || written > 999) return parse_double_slow(start, value);
    exponent += written;
  }
  if (!scale_decimal(mantissa, static_cast<int>(exponent), value)) {
    return parse_double_slow(start, value);
  }
  if (negative) value = -value;
  return p;
}

/// Reads words and numbers from text that is padded as FileBytes's is. White space separates;
/// a comment runs from the comment character ('\0': there are none) to the end of its line.
/// Every failure is thrown with its line and with what was being read at that moment.
class TextScanner {
 public:
  /// Reads `text` from byte `start` on.
  TextScanner(std::string_view text, char comment, std::size_t start = 0)
      : text_(text), p_(text.data() + start), end_(text.data() + text.size()), comment_(comment) {}

  /// Says what is read from now on, for messages: "in vertex 7 of 8", "in facet 7" (count 0), "in
  /// the header" (number 0). `thing` must outlive the scanner.
  void now_reading(const char* thing, std::int64_t number = 0, std::int64_t count = 0) {
    thing_ = thing;
    number_ = number;
    count_ = count;
  }

  bool at_end() { return next() == end_; }

  /// The next word, without taking it; empty at the end.
  std::string_view peek();

  /// Takes the next word; empty at the end.
  std::string_view word();

  /// Takes a number; throws when it is none or the text ends.
  double number();

  /// Takes a number; throws when it is none, the text ends, or it is not finite.
  double coordinate();

  /// Takes a whole number; throws when it is none or the text ends.
  std::int64_t integer();

  /// Goes to the end of the line.
  void skip_line();

  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - p_); }

  /// Throws "line N: cause in THING NUMBER of COUNT", for the word that was taken last.
  [[noreturn]] void fail(const std::string& cause, Hint hint = {}) const;

 private:
  const char* next();
  [[noreturn]] void fail_unreadable(const char* expected) const;

  std::string_view text_;
  const char* p_;
  const char* end_;
  const char* last_ = p_;  ///< start of the last word
  char comment_;
  const char* thing_ = nullptr;
  std::int64_t number_ = 0;
  std::int64_t count_ = 0;
};

/// A count of things of which the rest of the scanner's file holds `most`: fails where there are
/// to be more, before memory is asked for. `announced`: what messages begin with.
template <class Scanner>
std::size_t checked_count(const Scanner& scanner, std::int64_t count, const char* things,
                          std::size_t most, const char* announced = "there are to be ") {
  if (count < 0 || static_cast<std::uint64_t>(count) > most) {
    scanner.fail(announced + std::to_string(count) + ' ' + things + ", but only " +
                 std::to_string(scanner.bytes_left()) + " bytes follow");
  }
  return static_cast<std::size_t>(count);
}

}  // namespace geotherm::io
