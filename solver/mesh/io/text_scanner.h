// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "geotherm/error.h"

namespace geotherm::io {

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

}  // namespace geotherm::io
