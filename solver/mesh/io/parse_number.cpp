// SPDX-License-Identifier: MIT
#include "solver/mesh/io/parse_number.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace geotherm::io {
namespace {

/// True when the number, known to lie outside the range of double, is too large (not too small).
bool is_too_large(std::string_view text) {
  const std::size_t mark = text.find_first_of("eE");
  const std::string_view mantissa = text.substr(0, mark);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const auto first = static_cast<std::int64_t>(mantissa.find_first_of("123456789"));
  std::int64_t exponent = 0;
  if (mark != std::string_view::npos) {
    std::string_view digits = text.substr(mark + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (parsed.ec == std::errc::result_out_of_range) return !digits.starts_with('-');
  }
  // Above 1e300 or below 1e-300 as it is; the magnitude's sign decides. Divided, not added: the
  // exponent may be as large as an integer can be.
  return exponent / 2 + (static_cast<std::int64_t>(point) - first) / 2 > 0;
}

}  // namespace

const char* parse_double_slow(const char* p, double& value) {
  const bool plus = *p == '+';
  if (plus) ++p;
  if (plus && *p == '-') return nullptr;
  const char* end = p;
  while (static_cast<unsigned char>(*end) > ' ') ++end;
  const auto parsed = std::from_chars(p, end, value);
  if (parsed.ec == std::errc::invalid_argument) return nullptr;
  if (parsed.ec == std::errc::result_out_of_range) {
    const std::string_view text(p, static_cast<std::size_t>(parsed.ptr - p));
    value = is_too_large(text) ? std::numeric_limits<double>::infinity() : 0.0;
    if (text.starts_with('-')) value = -value;
  }
  return parsed.ptr;
}

}  // namespace geotherm::io
