// SPDX-License-Identifier: MIT
#include "app/explore/script.h"

#include <algorithm>
#include <cerrno>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "app/explore/saved_file.h"
#include "app/text.h"
#include "app/told.h"

namespace geotherm::app {
namespace {

/// Nothing but blanks, a comment or the line that is there for shells.
bool is_empty(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.front() == '#' || line == kInertLine;
}

Result<std::string> read_text(const std::string& path) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) {
    return Error{ErrorCode::kBadFile, one_line(path) + ": is a directory, not a script"};
  }
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.bad() && file.is_open()) return text;
  const std::string reason = std::error_code(errno, std::generic_category()).message();
  return Error{ErrorCode::kBadFile, one_line(path) + ": " + reason + "; name a file of commands"};
}

}  // namespace

Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<ScriptLine> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), end == std::string_view::npos ? end : end + 1));
    if (is_empty(line)) continue;
    auto command = parse_command(line);
    if (!command) {
      return Error{ErrorCode::kBadFile, one_line(name) + ": line " + std::to_string(number) + ", " +
                                            told(command.error())};
    }
    lines.push_back({number, *std::move(command)});
  }
  return lines;
}

Result<std::vector<ScriptLine>> read_script(const std::string& path) {
  const auto text = read_text(path);
  if (!text) return text.error();
  return parse_script(*text, path);
}

std::vector<std::string> files_written_by(const std::string& script) {
  std::vector<std::string> files;
  std::set<std::string> seen = {script};
  std::deque<std::string> left = {script};
  for (; !left.empty(); left.pop_front()) {
    const auto lines = read_script(left.front());
    if (!lines) continue;
    for (const ScriptLine& line : *lines) {
      const auto* const run = std::get_if<command::Run>(&line.command);
      if (run != nullptr && seen.insert(run->path).second) left.push_back(run->path);
      const std::string* const path = saved_path(line.command);
      if (path != nullptr && std::ranges::find(files, *path) == files.end()) {
        files.push_back(*path);
      }
    }
  }
  return files;
}

}  // namespace geotherm::app
