// SPDX-License-Identifier: MIT
#include "app/session/command_words.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

#include "app/session/settings.h"
#include "app/session/sources.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool is_control(char c) { return (c >= 0 && c < ' ') || c == 0x7f; }

/// What stands without quotes: nothing that means something to a shell.
constexpr std::string_view kPlain =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
/// What a shell looks into even within double quotes.
constexpr std::string_view kActive = "$`!";
constexpr std::string_view kDigits = "0123456789abcdef";

/// Also letters beyond ASCII.
bool is_plain(std::string_view word) {
  if (word.empty()) return false;
  while (!word.empty()) {
    const std::size_t length = printable_length(word);
    if (length == 0 || (length == 1 && kPlain.find(word[0]) == kPlain.npos)) return false;
    word.remove_prefix(length);
  }
  return true;
}

/// The byte of two hexadecimal digits at the front.
std::optional<char> byte_in_digits(std::string_view text) {
  if (text.size() < 2) return std::nullopt;
  const std::size_t high = kDigits.find(text[0]), low = kDigits.find(text[1]);
  if (high == kDigits.npos || low == kDigits.npos) return std::nullopt;
  return static_cast<char>(16 * high + low);
}

std::string column_text(std::size_t column) { return "column " + std::to_string(column) + ": "; }

/// The word in quotes that begins at line[at], which becomes the place behind it.
Result<std::string> quoted_word(std::string_view line, std::size_t& at) {
  const std::size_t begin = at++;
  std::string text;
  for (; at < line.size() && line[at] != '"'; ++at) {
    const bool escapes = line[at] == '\\' && at + 1 < line.size();
    if (!escapes) {
      text += line[at];
      continue;
    }
    switch (line[++at]) {
      case '"':
      case '\\':
        text += line[at];
        break;
      case 'n':
        text += '\n';
        break;
      case 'x':
        if (const auto byte = byte_in_digits(line.substr(at + 1))) {
          text += *byte;
          at += 2;
          break;
        }
        [[fallthrough]];
      default:
        return Error{ErrorCode::kBadInput, column_text(at) +
                                               "expected \\\", \\\\, \\n or \\x and two of 0-9 "
                                               "and a-f within quotes"};
    }
  }
  if (at == line.size()) {
    return Error{ErrorCode::kBadInput, column_text(begin + 1) + "this quote is not closed"};
  }
  // The system ends a path there, and what stands behind would decide what may be written.
  if (text.find('\0') != text.npos) {
    return Error{ErrorCode::kBadInput,
                 column_text(begin + 1) + "a zero byte, \\x00, stands in no path and in no text",
                 {"leave it out"}};
  }
  ++at;
  if (at < line.size() && !is_blank(line[at])) {
    return Error{ErrorCode::kBadInput, column_text(at + 1) + "expected a blank after the quote"};
  }
  return text;
}

}  // namespace

std::string command_word(const std::string& word) {
  if (is_plain(word)) return word;
  std::string out = "\"";
  for (std::string_view rest = word; !rest.empty();) {
    const std::size_t length = printable_length(rest);
    const char c = rest.front();
    if (c == '\n') {
      out += "\\n";
    } else if (length == 0 || kActive.find(c) != kActive.npos) {
      const auto byte = static_cast<unsigned char>(c);
      out += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 0xfU]};
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += rest.substr(0, length);
    }
    rest.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out + '"';
}

std::vector<std::string> paths_that_begin(std::string_view begun) {
  const std::size_t slash = begun.rfind('/');
  const std::string folder(slash == std::string_view::npos ? "" : begun.substr(0, slash + 1));
  std::vector<std::string> all;
  std::error_code unknown;
  std::filesystem::directory_iterator entries(folder.empty() ? "." : folder, unknown);
  constexpr std::size_t kMaxPaths = 1000;
  for (const auto end = std::filesystem::directory_iterator();
       !unknown && entries != end && all.size() < kMaxPaths; entries.increment(unknown)) {
    const std::string name = entries->path().filename().string();
    const bool hidden = name.starts_with('.') && begun.substr(folder.size()).empty();
    if (hidden || name.find_first_of(" \t\"'#\\") != std::string::npos) continue;
    std::error_code none;
    std::string path = folder + name + (entries->is_directory(none) ? "/" : "");
    if (path.starts_with(begun)) all.push_back(std::move(path));
  }
  std::ranges::sort(all);
  return all;
}

Result<double> parse_max_distance(const std::string& text) {
  const auto most = number_in<double>(text);
  if (most && *most > 0 && std::isfinite(*most)) return *most;
  return bad_value(text, "is no length above 0", "give one in model units");
}

Result<WordReader> WordReader::of(std::string_view line) {
  WordReader reader;
  std::size_t at = 0;
  while (at < line.size()) {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    if (line[at] == '#') break;
    reader.end_column_ = at + 1;
    Word word{{}, at + 1};
    if (line[at] == '"') {
      auto text = quoted_word(line, at);
      if (!text) return text.error();
      word.text = *std::move(text);
    } else {
      const std::size_t begin = at;
      while (at < line.size() && !is_blank(line[at]) && line[at] != '#') {
        if (line[at] == '"' || is_control(line[at])) {
          return Error{ErrorCode::kBadInput,
                       column_text(at + 1) + "expected a word",
                       {"one with quotes or control characters stands in double quotes"}};
        }
        ++at;
      }
      word.text = line.substr(begin, at - begin);
    }
    reader.end_column_ = at + 1;
    reader.words_.push_back(std::move(word));
  }
  return reader;
}

Error WordReader::fail(const std::string& what) const {
  const std::size_t column = at_end() ? end_column_ : words_[next_].column;
  std::string text = column_text(column) + "expected " + what;
  if (!at_end()) text += ", not '" + one_line(words_[next_].text) + "'";
  return {ErrorCode::kBadInput, std::move(text)};
}

Error WordReader::blame_last(Error why) const {
  why.message.insert(0, column_text(words_[next_ - 1].column));
  return why;
}

Result<std::vector<Index>> WordReader::vertices() {
  const auto spec = parse_source(peek());
  const auto* const list = spec ? std::get_if<VertexList>(&*spec) : nullptr;
  if (list == nullptr) return fail("vertex ids, such as 3,99,512");
  ++next_;
  return list->vertices;
}

Result<std::string> WordReader::one_of(const std::vector<std::string>& names) {
  if (std::ranges::find(names, peek()) == names.end()) return fail(joined(names, " or "));
  return next();
}

Result<void> WordReader::take(double& number, double least, double most) {
  const auto value = number_in<double>(peek());
  if (!value || !(*value >= least && *value <= most)) {
    const bool any = least == -kLargestNumber;
    return fail(most != kLargestNumber
                    ? "a number from " + number_text(least) + " to " + number_text(most)
                    : (any ? "a number" : "a number above 0"));
  }
  ++next_;
  number = *value;
  return {};
}

Result<void> WordReader::take(int& index) {
  const auto value = number_in<int>(peek());
  if (!value || *value < 0) return fail("the number of a " + words_.front().text + ", from 0");
  ++next_;
  index = *value;
  return {};
}

Result<void> WordReader::take(bool& on) {
  const auto word = one_of({"on", "off"});
  if (!word) return word.error();
  on = *word == "on";
  return {};
}

Result<void> WordReader::take(std::string& text) {
  text = next();
  return {};
}

Result<void> WordReader::take(Shown& shown) {
  const auto name = one_of(all_names<Shown>());
  return name ? store(parse<Shown>(*name), shown) : name.error();
}

Result<void> WordReader::take(SourceSpec& source) {
  auto spec = parse_source(next());
  return spec ? store(std::move(spec), source) : blame_last(spec.error());
}

Result<void> WordReader::take(FacePoint& touch) {
  std::optional<FacePoint> point;
  if (!take(point)) return fail("a point in a face, face:ID:b0:b1:b2");
  if (point->offset != 0) return blame_last({ErrorCode::kBadInput, "a touch has no offset"});
  touch = *point;
  return {};
}

Result<void> WordReader::take(std::optional<FacePoint>& point) {
  const auto spec = parse_source(peek());
  if (!spec || !std::holds_alternative<FacePoint>(*spec)) {
    return fail("a point in a face, face:ID:b0:b1:b2, or none");
  }
  ++next_;
  point = std::get<FacePoint>(*spec);
  return {};
}

Result<void> WordReader::take(std::optional<SourceSpec>& point) {
  auto spec = parse_source(peek());
  if (!spec || !is_single_point(*spec)) {
    return fail("a point (a vertex id, face:ID:b0:b1:b2 or xyz:x:y:z) or none");
  }
  ++next_;
  return store(std::move(spec), point);
}

Result<void> WordReader::take(std::optional<CentreKind>& kind) {
  std::vector<std::string> names = all_names<CentreKind>();
  names.emplace_back("none");
  const auto name = one_of(names);
  return name ? store(parse<CentreKind>(*name), kind) : name.error();
}

}  // namespace geotherm::app
