// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "solver/mesh/io/input_file.h"

namespace geotherm::io {

/// The header of a file in which text comes before the data, line by line and word by word.
class HeaderLines {
 public:
  explicit HeaderLines(std::string_view bytes) : bytes_(bytes), next_(bytes.data()) {}

  /// Goes on to the next line; false: the file has ended.
  bool next_line() {
    const char* const end = bytes_.data() + bytes_.size();
    if (next_ == end) return false;
    start_ = next_;
    const std::string_view rest(start_, static_cast<std::size_t>(end - start_));
    line_ = rest.substr(0, rest.find('\n'));
    next_ = start_ + std::min(line_.size() + 1, rest.size());
    return true;
  }

  /// The next word of the line; empty: there is none.
  std::string_view word() {
    constexpr std::string_view kBlanks = " \t\r";
    line_.remove_prefix(std::min(line_.find_first_not_of(kBlanks), line_.size()));
    const std::string_view found = line_.substr(0, line_.find_first_of(kBlanks));
    line_.remove_prefix(found.size());
    return found;
  }

  /// Blames this line.
  [[noreturn]] void fail(const std::string& cause, Hint hint = {}) const {
    fail_at_line(bytes_, start_, cause, std::move(hint));
  }

  std::string_view bytes() const { return bytes_; }
  /// What comes after this line.
  const char* next() const { return next_; }

 private:
  std::string_view bytes_;
  const char* next_;           ///< the next line
  const char* start_ = next_;  ///< this line
  std::string_view line_;      ///< what is left of this line
};

}  // namespace geotherm::io
