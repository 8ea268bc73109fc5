// SPDX-License-Identifier: MIT
#include "solver/mesh/io/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include "solver/mesh/io/input_file.h"

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

namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

const char* TextScanner::next() {
  for (;;) {
    while (is_space(*p_)) ++p_;
    if (comment_ == '\0' || *p_ != comment_ || p_ == end_) return p_;
    skip_line();
  }
}

std::string_view TextScanner::peek() {
  const char* last = next();
  while (last < end_ && !is_space(*last) && (comment_ == '\0' || *last != comment_)) ++last;
  return {p_, static_cast<std::size_t>(last - p_)};
}

std::string_view TextScanner::word() {
  const std::string_view found = peek();
  last_ = p_;
  p_ += found.size();
  return found;
}

double TextScanner::number() {
  last_ = next();
  double value = 0;
  const char* const after = parse_double(p_, value);
  if (after == nullptr || !(is_space(*after) || after == end_ || *after == comment_)) {
    fail_unreadable("a number");
  }
  p_ = after;
  return value;
}

double TextScanner::coordinate() {
  const double value = number();
  if (!std::isfinite(value)) fail("the coordinate " + quoted(text_, last_) + " is not finite");
  return value;
}

std::int64_t TextScanner::integer() {
  last_ = next();
  std::int64_t value = 0;
  const char* const after = parse_integer(p_, value);
  if (after == nullptr || !(is_space(*after) || after == end_ || *after == comment_)) {
    fail_unreadable("a whole number");
  }
  p_ = after;
  return value;
}

void TextScanner::skip_line() {
  const std::size_t newline = std::string_view(p_, bytes_left()).find('\n');
  p_ = newline == std::string_view::npos ? end_ : p_ + newline;
}

void TextScanner::fail(const std::string& cause, Hint hint) const {
  std::string message = cause;
  if (thing_ != nullptr) {
    message += std::string(" in ") + thing_;
    if (number_ > 0) message += ' ' + std::to_string(number_);
    if (count_ > 0) message += " of " + std::to_string(count_);
  }
  fail_at_line(text_, last_, message, std::move(hint));
}

void TextScanner::fail_unreadable(const char* expected) const {
  if (last_ == end_) fail("the file ends");
  fail(quoted(text_, last_) + " is not " + expected);
}

}  // namespace geotherm::io
