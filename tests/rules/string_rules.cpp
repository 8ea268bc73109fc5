// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <sstream>

#include "tests/rules/source_rules.h"

namespace geotherm::rules {
namespace {

/// Two dashes and a letter.
bool begins_with_option(std::string_view text) {
  return text.size() > 2 && text.starts_with("--") &&
         std::isalpha(static_cast<unsigned char>(text[2])) != 0;
}

/// The program's name with a word behind it.
bool begins_with_command(std::string_view text) {
  constexpr std::string_view kProgram = "geotherm ";
  return text.size() > kProgram.size() && text.starts_with(kProgram) &&
         std::islower(static_cast<unsigned char>(text[kProgram.size()])) != 0;
}

/// Whether `begins` holds somewhere in a string literal of the line; comments are passed over.
bool any_string_has(std::string_view line, bool (*begins)(std::string_view)) {
  bool in_string = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::string_view rest = line.substr(i);
    if (!in_string && rest.starts_with("//")) return false;
    if (!in_string && rest.starts_with("'\"'")) {
      i += 2;
    } else if (in_string && line[i] == '\\') {
      ++i;
    } else if (line[i] == '"') {
      in_string = !in_string;
    } else if (in_string && begins(rest)) {
      return true;
    }
  }
  return false;
}

bool lies_in_one_of(std::string_view path, std::span<const std::string_view> folders) {
  return std::ranges::any_of(folders, [&](std::string_view folder) {
    return path.starts_with(std::string(folder) + "/");
  });
}

}  // namespace

std::vector<Violation> check_option_names(const SourceFile& file) {
  constexpr std::string_view kNoProgram[] = {"solver", "engine"};
  constexpr std::string_view kBelowTheCommandLine[] = {
      "solver", "engine", "app/session", "app/picture", "app/drawing", "app/window", "ui"};
  std::vector<Violation> found;
  // The table of settings has the spellings of their options.
  const bool is_table = file.path == "app/session/method_settings.cpp" ||
                        file.path == "app/session/picture_settings_table.cpp";
  if (!is_code(file.path) || is_table || !lies_in_one_of(file.path, kBelowTheCommandLine)) {
    return found;
  }
  const bool in_library = lies_in_one_of(file.path, kNoProgram);
  std::istringstream stream(file.text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (any_string_has(line, begins_with_option)) {
      found.push_back({file.path, number, "a string names an option; a hint names a setting"});
    }
    if (in_library && any_string_has(line, begins_with_command)) {
      found.push_back({file.path, number, "a string names a sub-command of the program"});
    }
  }
  return found;
}

}  // namespace geotherm::rules
