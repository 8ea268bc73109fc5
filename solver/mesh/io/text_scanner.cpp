// SPDX-License-Identifier: MIT
#include "solver/mesh/io/text_scanner.h"

#include <cmath>
#include <utility>

#include "solver/mesh/io/parse_number.h"
#include "solver/mesh/io/read_failure.h"

namespace geotherm::io {
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
