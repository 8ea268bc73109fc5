// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {

/// Reads files whose keywords are text and whose arrays are text or binary, as those of Gmsh and
/// VTK: one piece of code reads both. Words are read as by TextScanner. An array stands between
/// begin_values() and end_values(); its numbers have the type that they have in the binary file.
/// Failures name the line, or the byte where the arrays are binary. Preconditions: text that is
/// padded as FileBytes's is.
class MixedScanner {
 public:
  MixedScanner(std::string_view bytes, char comment, std::size_t start = 0)
      : bytes_(bytes), comment_(comment), words_(bytes, comment, start) {}

  /// From now on arrays are binary in this order.
  void be_binary(std::endian order) {
    binary_ = true;
    order_ = order;
  }
  bool is_binary() const { return binary_; }

  /// What is read, for messages, as in TextScanner.
  void now_reading(const char* thing, std::int64_t number = 0, std::int64_t count = 0) {
    thing_ = thing;
    number_ = number;
    count_ = count;
    words_.now_reading(thing, number, count);
  }

  TextScanner& words() { return words_; }

  /// The first value follows: of a binary array behind the end of this line.
  void begin_values() {
    if (!binary_) return;
    words_.skip_line();
    p_ = bytes_.data() + std::min(bytes_.size(), place_of_words() + 1);
    last_ = p_;
  }

  /// Words follow.
  void end_values() {
    if (!binary_) return;
    words_ = TextScanner(bytes_, comment_, static_cast<std::size_t>(p_ - bytes_.data()));
    words_.now_reading(thing_, number_, count_);
    p_ = nullptr;
  }

  /// A whole number that the binary file stores as a T.
  template <class T>
  std::int64_t integer() {
    static_assert(std::is_integral_v<T>);
    return binary_ ? static_cast<std::int64_t>(take<T>()) : words_.integer();
  }

  /// A finite number that the binary file stores as a T.
  template <class T>
  double coordinate() {
    if (!binary_) return words_.coordinate();
    const auto value = static_cast<double>(take<T>());
    if (!std::isfinite(value)) fail("a coordinate is not finite");
    return value;
  }

  /// Passes over so many values of a T, finite or not.
  template <class T>
  void skip(std::int64_t values) {
    if (binary_) {
      if (values < 0 || static_cast<std::uint64_t>(values) > bytes_left() / sizeof(T)) {
        fail("the file ends");
      }
      p_ += static_cast<std::size_t>(values) * sizeof(T);
      return;
    }
    for (std::int64_t k = 0; k < values; ++k) {
      if (words_.word().empty()) words_.fail("the file ends");
    }
  }

  /// Among words: goes behind the next place where the text stands; false where there is none.
  bool pass(std::string_view text) {
    const std::size_t at = bytes_.find(text, place_of_words());
    if (at == bytes_.npos) return false;
    words_ = TextScanner(bytes_, comment_, at + text.size());
    return true;
  }

  /// Bytes behind what was read, in the array or the text.
  std::size_t bytes_left() const {
    return binary_ && p_ != nullptr ? static_cast<std::size_t>(bytes_.data() + bytes_.size() - p_)
                                    : words_.bytes_left();
  }

  /// A count of things, each of which takes some bytes at least.
  std::size_t checked_count(std::int64_t count, const char* things, std::size_t bytes_each) const {
    return io::checked_count(*this, count, things, (bytes_left() + 1) / bytes_each);
  }

  /// Fails for a reason that lies in the word or the value that was taken last.
  [[noreturn]] void fail(const std::string& cause, Hint hint = {}) const {
    if (!binary_ || p_ == nullptr) words_.fail(cause, std::move(hint));
    std::string message = cause;
    if (thing_ != nullptr) {
      message += std::string(" in ") + thing_;
      if (number_ > 0) message += ' ' + std::to_string(number_);
      if (count_ > 0) message += " of " + std::to_string(count_);
    }
    fail_at_byte(bytes_, last_, message, std::move(hint));
  }

 private:
  std::size_t place_of_words() const { return bytes_.size() - words_.bytes_left(); }

  template <class T>
  T take() {
    last_ = p_;
    if (bytes_left() < sizeof(T)) fail("the file ends");
    p_ += sizeof(T);
    return load<T>(last_, order_);
  }

  std::string_view bytes_;
  char comment_;
  TextScanner words_;
  bool binary_ = false;
  std::endian order_ = std::endian::little;
  const char* p_ = nullptr;     ///< in a binary array; null among words
  const char* last_ = nullptr;  ///< start of the last value
  const char* thing_ = nullptr;
  std::int64_t number_ = 0;
  std::int64_t count_ = 0;
};

}  // namespace geotherm::io
