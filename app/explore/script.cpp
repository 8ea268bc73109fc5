// SPDX-License-Identifier: MIT
#include <algorithm>

#include "app/explore/command.h"
#include "app/text.h"

namespace geotherm::app {
namespace {

/// Nothing but blanks and a comment.
bool is_empty(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.front() == '#';
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
                                            command.error().message};
    }
    lines.push_back({number, *std::move(command)});
  }
  return lines;
}

}  // namespace geotherm::app
