// SPDX-License-Identifier: MIT
#include "geotherm/error.h"

namespace geotherm {

std::vector<SettingHint> settings_of(const Hint& hint) {
  std::vector<SettingHint> settings;
  for (const auto& part : hint) {
    const auto* const setting = std::get_if<SettingHint>(&part);
    if (setting != nullptr && !setting->values.empty()) settings.push_back(*setting);
  }
  return settings;
}

std::string hint_text(const Hint& hint, std::string_view before_name) {
  std::string text;
  for (const auto& part : hint) {
    if (const auto* const words = std::get_if<std::string>(&part)) {
      text += *words;
      continue;
    }
    const SettingHint& setting = std::get<SettingHint>(part);
    text.append(before_name) += setting.name;
    const char* between = " ";
    for (const std::string& value : setting.values) {
      text += between + value;
      between = " or ";
    }
  }
  return text;
}

std::string sentence(const std::string& message, const Hint& hint, std::string_view before_name) {
  return hint.empty() ? message : message + "; " + hint_text(hint, before_name);
}

std::string sentence(const Warning& warning, std::string_view before_name) {
  return sentence(warning.message, warning.hint, before_name);
}

std::string sentence(const Error& error, std::string_view before_name) {
  const std::string subject = error.subject.empty() ? "" : error.subject + ": ";
  return sentence(subject + error.message, error.hint, before_name);
}

}  // namespace geotherm
