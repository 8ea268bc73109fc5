// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

// Expected failures are values: a Result<T> holds a T or an Error with a code, a sentence and a
// hint. The library throws nothing of its own; in functions that return a Result std::bad_alloc
// becomes ErrorCode::kOutOfMemory.
namespace geotherm {

/// A setting by the name that the library has for it ("backend", "time-factor", "memory-limit"),
/// and values of which any may help.
struct SettingHint {
  std::string name;                      ///< of the setting
  std::vector<std::string> values = {};  ///< as text; empty: the words around it say what to give

  bool operator==(const SettingHint&) const = default;
};

/// What to do about an error or a warning: words, and settings where their names stand among them.
/// {"try ", SettingHint{"backend", {"cg"}}, ", which needs no factor"}. Empty: nothing is known to
/// help.
using Hint = std::vector<std::variant<std::string, SettingHint>>;

/// What a person should know of an answer that was given.
struct Warning {
  std::string message;  ///< one sentence: what is wrong, with the numbers
  Hint hint = {};       ///< what to do about it

  bool operator==(const Warning&) const = default;
};

/// The settings of a hint that have values: what a program can apply.
std::vector<SettingHint> settings_of(const Hint& hint);

/// The hint as words: a setting is its name, with `before_name` in front, and its values:
/// "boundary neumann or average" where that is empty.
std::string hint_text(const Hint& hint, std::string_view before_name = {});

/// "MESSAGE; HINT".
std::string sentence(const std::string& message, const Hint& hint,
                     std::string_view before_name = {});
/// The warning as "MESSAGE; HINT".
std::string sentence(const Warning& warning, std::string_view before_name = {});

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
  ErrorCode code = ErrorCode::kBadInput;  ///< for programs
  std::string message;                    ///< one sentence: what is wrong, with the numbers
  Hint hint = {};                         ///< what to do about it
  std::string subject = {};  ///< of whom the message speaks, where others may: a backend
};

/// "SUBJECT: MESSAGE; HINT", as far as there are such; the hint as in hint_text().
std::string sentence(const Error& error, std::string_view before_name = {});

/// A backend that could not do the work that was asked of it, and why.
struct Fallback {
  std::string backend;  ///< its name
  Error error;          ///< why
};

/// A value or an Error: the subset of std::expected (C++23) that this library uses.
template <class T>
class [[nodiscard]] Result {
 public:
  /// Success.
  Result(T value)
      : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT: implicit on purpose
  /// Failure.
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT

  /// Whether it is a value.
  bool has_value() const { return state_.index() == 0; }
  /// The same as has_value().
  explicit operator bool() const { return has_value(); }

  /// The value. Precondition: has_value().
  T& value() & { return assert(has_value()), std::get<0>(state_); }
  const T& value() const& { return assert(has_value()), std::get<0>(state_); }
  T&& value() && { return assert(has_value()), std::get<0>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  /// Why there is no value. Precondition: there is none.
  const Error& error() const { return assert(!has_value()), std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  /// Success.
  Result() = default;
  /// Failure.
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit on purpose

  /// Whether it is a success.
  bool has_value() const { return !error_; }
  /// The same as has_value().
  explicit operator bool() const { return has_value(); }
  /// Why it failed. Precondition: it is no success.
  const Error& error() const { return assert(error_), *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace geotherm
