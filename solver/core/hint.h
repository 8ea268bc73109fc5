// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace geotherm {

/// A setting by the name that the library has for it ("backend", "time-factor", "memory-limit"),
/// and values of which any may help.
struct SettingHint {
  std::string name;
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
  Hint hint = {};

  bool operator==(const Warning&) const = default;
};

/// Those that have values: what a program can apply.
std::vector<SettingHint> settings_of(const Hint& hint);

/// The hint as words: a setting is its name, with `before_name` in front, and its values:
/// "--boundary neumann or average" where that is "--".
std::string hint_text(const Hint& hint, std::string_view before_name = {});

/// "MESSAGE; HINT".
std::string sentence(const std::string& message, const Hint& hint,
                     std::string_view before_name = {});
std::string sentence(const Warning& warning, std::string_view before_name = {});

}  // namespace geotherm
