// SPDX-License-Identifier: MIT
#include "solver/core/text.h"

#include <algorithm>
#include <utility>

#include "geotherm/names.h"

namespace geotherm {
namespace {

struct Character {
  char32_t code = 0;
  std::size_t length = 0;  ///< bytes; 0: no UTF-8
};

Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead < 0xc2   ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  if (length == 0 || length > text.size()) return {};
  char32_t code = lead & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6U | (byte(i) & 0x3fU);
  }
  constexpr char32_t kMin[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  if (code < kMin[length] || code > 0x10ffff || surrogate) return {};
  return {code, length};
}

}  // namespace

std::size_t printable_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto [code, length] = first_character(text);
  const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
  const bool turns = (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  const bool nothing = code == 0xfffe || code == 0xffff;
  return control || turns || nothing ? 0 : length;
}

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = printable_length(text);
    out += length == 0 ? std::string_view("?") : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

namespace {

/// Letters to change, add, leave out or swap with their neighbour to make one word the other.
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> apart(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      std::size_t& least = apart[i][j] = i + j;
      if (i == 0 || j == 0) continue;
      least = std::min({apart[i - 1][j] + 1, apart[i][j - 1] + 1,
                        apart[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        least = std::min(least, apart[i - 2][j - 2] + 1);
      }
    }
  }
  return apart[a.size()][b.size()];
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 40;  // a longer word is no slip of the keyboard
  if (word.size() > kLongest) return {};
  std::size_t least = std::min<std::size_t>(word.size() / 3, 3) + 1;
  std::string nearest;
  for (const std::string& each : known) {
    const std::size_t apart = letters_apart(word, each);
    if (apart >= least) continue;
    least = apart;
    nearest = each;
  }
  return nearest;
}

std::string known_words(std::string_view word, const std::vector<std::string>& known) {
  const std::string near = nearest_word(word, known);
  std::string text = near.empty() ? "" : "did you mean " + near + "? ";
  text += "there are ";
  for (const std::string& each : known) text += (&each == &known.front() ? "" : ", ") + each;
  return text;
}

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

Error unknown_name(ErrorCode code, std::string_view unknown, std::string_view text,
                   const std::vector<std::string>& names) {
  std::string message(unknown);
  message.replace(message.find('*'), 1, printable(text));
  return {code, std::move(message), {known_words(text, names)}};
}

std::string sentence(const Error& error, std::string_view before_name) {
  const std::string subject = error.subject.empty() ? "" : error.subject + ": ";
  return sentence(subject + error.message, error.hint, before_name);
}

}  // namespace geotherm
