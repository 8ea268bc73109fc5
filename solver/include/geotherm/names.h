// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "geotherm/error.h"

// Values of an enum as text. Beside such an enum stands a function named_values() with its names;
// writing, reading and listing them need no more.
namespace geotherm {

/// The names of an enum.
template <class Enum>
struct NamedValues {
  std::string_view unknown;  ///< what is said of a text '*' that is none: "'*' is no heat mode"
  std::vector<std::pair<Enum, std::string_view>> all;  ///< the default first
  ErrorCode code = ErrorCode::kBadInput;               ///< of that error
};

/// An enum with names.
template <class Enum>
concept Named = std::is_enum_v<Enum> && requires(Enum value) {
  { named_values(value) } -> std::same_as<NamedValues<Enum>>;
};

/// The name of a value. parse<Enum>(to_text(value)) is that value.
template <Named Enum>
std::string to_text(Enum value) {
  for (const auto& [each, name] : named_values(value).all) {
    if (each == value) return std::string(name);
  }
  return "?";
}

/// Every name, the default first.
template <Named Enum>
std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& [each, name] : named_values(Enum{}).all) names.emplace_back(name);
  return names;
}

/// Every value, in the order of named_values().
template <Named Enum>
std::vector<Enum> all_values() {
  std::vector<Enum> values;
  for (const auto& [each, name] : named_values(Enum{}).all) values.push_back(each);
  return values;
}

/// Says that a text is none of the names.
Error unknown_name(ErrorCode code, std::string_view unknown, std::string_view text,
                   const std::vector<std::string>& names);

/// The value of a name. Errors: NamedValues::code, with the names there are.
template <Named Enum>
Result<Enum> parse(std::string_view text) {
  const NamedValues<Enum> values = named_values(Enum{});
  for (const auto& [value, name] : values.all) {
    if (name == text) return value;
  }
  return unknown_name(values.code, values.unknown, text, all_names<Enum>());
}

}  // namespace geotherm
