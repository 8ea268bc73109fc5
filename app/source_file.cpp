// SPDX-License-Identifier: MIT
#include <filesystem>
#include <system_error>

#include "app/source_spec.h"
#include "app/text.h"
#include "app/told.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::app {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r\f\v";
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(kBlank); begin != std::string_view::npos;) {
    const std::size_t end = line.find_first_of(kBlank, begin);
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlank, end);
  }
  return words;
}

Result<SourceSpec> parse_words(const std::vector<std::string_view>& words) {
  if (words.size() == 3) return parse_space_point({words[0], words[1], words[2]});
  if (words.size() == 1) {
    const std::string_view word = words[0];
    const bool is_point = word.starts_with("face:") || word.starts_with("xyz:");
    if (is_point || word.find('@') != std::string_view::npos) return parse_source(word);
    const auto vertex = number_in<Index>(word);
    if (vertex && *vertex >= 0) return SourceSpec(VertexList{{*vertex}});
  }
  return Error{
      ErrorCode::kBadInput,
      "'" + one_line(std::string(words[0])) + (words.size() > 1 ? " ...'" : "'") + " is no source",
      {"write a vertex id, face:ID:b0:b1:b2, xyz:x:y:z, or the three numbers x y z"}};
}

Result<std::vector<Source>> as_curve(const std::string& shown, const std::vector<Source>& sources,
                                     const std::vector<int>& lines) {
  VertexCurve curve;
  curve.lines = lines;
  for (const Source& source : sources) {
    const auto* list = std::get_if<VertexList>(&source.spec);
    if (list == nullptr) {
      return Error{ErrorCode::kBadFile,
                   source.where + ": not a vertex id; --curve joins vertices, one id a line"};
    }
    curve.vertices.push_back(list->vertices.front());
  }
  return std::vector<Source>{{std::move(curve), shown, ErrorCode::kBadFile}};
}

}  // namespace

Result<std::vector<Source>> read_source_file(const std::string& path, bool curve) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) {
    return Error{ErrorCode::kBadFile,
                 one_line(path) + ": is a folder; give a file with one vertex id or point a line"};
  }
  const auto file = io::FileBytes::read(path);
  if (!file) {
    return with_hint(file.error(), {std::filesystem::exists(path, unknown)
                                        ? "give a file with one vertex id or point a line"
                                        : "check the path"});
  }
  const std::string shown = one_line(path);
  std::string_view rest = file->bytes();
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  std::vector<Source> sources;
  std::vector<int> lines;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    line = line.substr(0, line.find('#'));
    const auto words = words_of(line);
    if (words.empty()) continue;
    std::string where = shown + ": line " + std::to_string(number);
    auto spec = parse_words(words);
    if (!spec) {
      return with_hint(about(where, spec.error(), ErrorCode::kBadFile), {"write finite numbers"});
    }
    sources.push_back({*std::move(spec), std::move(where), ErrorCode::kBadFile});
    lines.push_back(number);
  }
  if (sources.empty()) {
    return Error{ErrorCode::kBadFile,
                 shown + ": holds no source; write one vertex id or point a line"};
  }
  if (!curve) return sources;
  return as_curve(shown, sources, lines);
}

}  // namespace geotherm::app
