// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "solver/core/hint.h"

namespace geotherm {

/// Why an operation failed. The vocabulary is shared by files, backends and sub-commands.
enum class ErrorCode {
  kBadInput,          ///< the caller's arguments or the mesh itself; another input would work
  kBadFile,           ///< a file that cannot be opened, read, parsed or written
  kNotAvailable,      ///< a name this build does not know (a backend, a format, a model)
  kNumericalFailure,  ///< a matrix that is not positive definite, a value that is not finite
  kBudgetEnded,       ///< an iteration budget ended before the tolerance was reached
  kOutOfMemory,       ///< the message says how much was asked for
  kCancelled,         ///< the caller asked to stop
  kNoDevice,          ///< no device that can draw, or it was lost
};

/// An expected failure: a code for programs, what is wrong and what to do about it for people.
struct Error {
  ErrorCode code = ErrorCode::kBadInput;
  std::string message;  ///< one sentence: what is wrong, with the numbers
  Hint hint = {};
  std::string subject = {};  ///< of whom the message speaks, where others may: a backend
};

/// "SUBJECT: MESSAGE; HINT", as far as there are such; the hint as in hint_text().
std::string sentence(const Error& error, std::string_view before_name = {});

/// A value or an Error: the subset of std::expected (C++23) that this library uses.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value)
      : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT: implicit on purpose
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT

  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  T& value() & { return assert(has_value()), std::get<0>(state_); }
  const T& value() const& { return assert(has_value()), std::get<0>(state_); }
  T&& value() && { return assert(has_value()), std::get<0>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const { return assert(!has_value()), std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit on purpose

  bool has_value() const { return !error_; }
  explicit operator bool() const { return has_value(); }
  const Error& error() const { return assert(error_), *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace geotherm
