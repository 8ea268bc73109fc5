// SPDX-License-Identifier: MIT
#include "app/session/sources.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <span>
#include <system_error>

#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::app {
namespace {

/// Weights are accepted when they sum to 1 within this (0.333:0.333:0.334 and the like), and are
/// then divided by their sum: but for those that sum to 1 within the second, a few roundings, which
/// stay as they are and so read back the same.
constexpr double kWeightSum = 1e-3;
constexpr double kWeightRounding = 4 * std::numeric_limits<double>::epsilon();

Error unreadable(std::string message, Hint hint = {}) {
  return {ErrorCode::kBadInput, std::move(message), std::move(hint)};
}

std::string quoted(std::string_view text) { return "'" + one_line(std::string(text)) + "'"; }

Result<std::array<double, 3>> three_numbers(std::span<const std::string_view> parts) {
  std::array<double, 3> numbers{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = number_in<double>(parts[k]);
    if (!number || !std::isfinite(*number)) {
      return unreadable(quoted(parts[k]) + " is no finite number",
                        {"write one such as -1.5 or 2e-3"});
    }
    numbers[k] = *number;
  }
  return numbers;
}

Result<SourceSpec> parse_vertices(std::string_view text) {
  VertexList list;
  for (const std::string_view part : split(text, ',')) {
    const auto vertex = number_in<Index>(trimmed(part));
    if (!vertex || *vertex < 0) {
      return unreadable(
          quoted(text) + " is no source",
          {"write vertex ids from 0 (17 or 3,99,512), curve:V1,V2,... or curve:face:..., "
           "random:K[:SEED], boundary, face:ID:b0:b1:b2, xyz:x:y:z or sample:i:j[:k]"});
    }
    list.vertices.push_back(*vertex);
  }
  return SourceSpec(std::move(list));
}

Result<SourceSpec> parse_random(std::string_view text, const std::vector<std::string_view>& parts) {
  const auto unread = [&] {
    return unreadable(quoted(text) + " does not say how many vertices",
                      {"write random:K or random:K:SEED, both whole numbers"});
  };
  if (parts.size() < 2 || parts.size() > 3) return unread();
  RandomVertices random;
  const auto count = number_in<Index>(parts[1]);
  if (const auto more = number_in<std::int64_t>(parts[1]); !count && more && *more > 0) {
    return unreadable(quoted(text) + " asks for more vertices than a model can have",
                      {"give at most " + std::to_string(std::numeric_limits<Index>::max())});
  }
  if (!count) return unread();
  random.count = *count;
  if (parts.size() == 3) {
    const auto seed = number_in<std::uint64_t>(parts[2]);
    if (!seed) return unread();
    random.seed = *seed;
  }
  if (random.count < 1) {
    return unreadable("random:" + std::to_string(random.count) + " asks for no vertex",
                      {"give 1 or more"});
  }
  return SourceSpec(random);
}

Result<SourceSpec> parse_face(std::string_view text, const std::vector<std::string_view>& parts) {
  const auto face = parts.size() == 5 ? number_in<Index>(parts[1]) : std::nullopt;
  if (!face || *face < 0) {
    return unreadable(quoted(text) + " is no point in a face",
                      {"write face:ID:b0:b1:b2, with the weights of its corners"});
  }
  auto weights = three_numbers(std::span(parts).subspan(2));
  if (!weights) return about(quoted(text), weights.error());
  double sum = 0;
  for (const double w : *weights) {
    if (w < 0) {
      return unreadable(quoted(text) + ": the weight " + significant(w) + " is negative",
                        {"barycentric weights are not, and sum to 1"});
    }
    sum += w;
  }
  if (std::abs(sum - 1) > kWeightSum) {
    return unreadable(quoted(text) + ": the weights sum to " + significant(sum),
                      {"barycentric weights are not negative and sum to 1"});
  }
  if (std::abs(sum - 1) > kWeightRounding) {
    for (double& w : *weights) w /= sum;
  }
  return SourceSpec(FacePoint{*face, *weights});
}

Result<SourceSpec> parse_surface_curve(std::string_view points) {
  SurfaceCurve curve;
  for (const std::string_view point : split(points, ',')) {
    const auto parts = split(trimmed(point), ':');
    if (parts[0] != "face") {
      return unreadable(quoted(point) + " is no point of a curve across faces",
                        {"write curve:face:ID:b0:b1:b2,face:ID:b0:b1:b2,..."});
    }
    auto read = parse_face(trimmed(point), parts);
    if (!read) return read;
    curve.points.push_back(std::get<FacePoint>(*read));
  }
  return SourceSpec(std::move(curve));
}

Result<SourceSpec> parse_curve(std::string_view ids) {
  if (trimmed(ids).starts_with("face:")) return parse_surface_curve(ids);
  VertexCurve curve;
  for (const std::string_view part : split(ids, ',')) {
    const auto vertex = number_in<Index>(trimmed(part));
    if (!vertex || *vertex < 0) {
      return unreadable(quoted(part) + " is no vertex of a curve",
                        {"write curve:V1,V2,... with ids from 0, or points in faces alone"});
    }
    curve.vertices.push_back(*vertex);
  }
  return SourceSpec(std::move(curve));
}

Result<SourceSpec> parse_sample(std::string_view text, const std::vector<std::string_view>& parts) {
  GridSample sample;
  bool valid = parts.size() == 3 || parts.size() == 4;
  for (std::size_t e = 0; valid && e + 1 < parts.size(); ++e) {
    const auto place = number_in<Index>(parts[e + 1]);
    valid = place && *place >= 0;
    if (valid) sample.place[e] = *place;
  }
  if (valid) return SourceSpec(sample);
  return unreadable(quoted(text) + " is no sample of a grid",
                    {"write sample:i:j or sample:i:j:k, places along x, y and z from 0"});
}

Result<SourceSpec> parse_plain(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (text == "boundary") return SourceSpec(WholeBoundary{});
  if (text.starts_with("curve:")) return parse_curve(text.substr(6));
  if (parts[0] == "random") return parse_random(text, parts);
  if (parts[0] == "face") return parse_face(text, parts);
  if (parts[0] == "sample") return parse_sample(text, parts);
  if (parts[0] == "xyz") {
    if (parts.size() != 4) {
      return unreadable(quoted(text) + " is no point in space",
                        {"write xyz:x:y:z, in model units"});
    }
    auto point = parse_space_point({parts[1], parts[2], parts[3]});
    if (!point) return about(quoted(text), point.error());
    return point;
  }
  return parse_vertices(text);
}

/// The end of a point's text.
std::string offset_text(double offset) { return offset == 0 ? "" : '@' + number_text(offset); }

std::string ids_text(const std::vector<Index>& vertices) {
  std::string text;
  for (const Index v : vertices) text += (text.empty() ? "" : ",") + std::to_string(v);
  return text;
}

struct Writer {
  std::string operator()(const VertexList& list) const {
    return ids_text(list.vertices) + offset_text(list.offset);
  }
  std::string operator()(const VertexCurve& curve) const {
    return "curve:" + ids_text(curve.vertices);
  }
  std::string operator()(const SurfaceCurve& curve) const {
    std::string text;
    for (const FacePoint& point : curve.points) text += (text.empty() ? "" : ",") + (*this)(point);
    return "curve:" + text;
  }
  std::string operator()(const RandomVertices& random) const {
    std::string text = "random:" + std::to_string(random.count);
    if (random.seed != RandomVertices{}.seed) text += ':' + std::to_string(random.seed);
    return text + offset_text(random.offset);
  }
  std::string operator()(const WholeBoundary&) const { return "boundary"; }
  std::string operator()(const FacePoint& point) const {
    std::string text = "face:" + std::to_string(point.face);
    for (const double w : point.weights) text += ':' + number_text(w);
    return text + offset_text(point.offset);
  }
  std::string operator()(const SpacePoint& point) const {
    std::string text = "xyz";
    for (const double x : point.position) text += ':' + number_text(x);
    return text + offset_text(point.offset);
  }
  std::string operator()(const GridSample& sample) const {
    std::string text = "sample";
    for (const Index place : sample.place) text += ':' + std::to_string(place);
    return text + offset_text(sample.offset);
  }
};

}  // namespace

std::string to_text(const SourceSpec& spec) { return std::visit(Writer{}, spec); }

Result<SourceSpec> parse_space_point(const std::array<std::string_view, 3>& numbers) {
  const auto values = three_numbers(numbers);
  if (!values) return values.error();
  return SourceSpec(SpacePoint{Vec3((*values)[0], (*values)[1], (*values)[2])});
}

bool is_single_point(const SourceSpec& spec) {
  const auto* list = std::get_if<VertexList>(&spec);
  const auto* inside = std::get_if<FacePoint>(&spec);
  const auto* space = std::get_if<SpacePoint>(&spec);
  return (list && list->vertices.size() == 1 && list->offset == 0) ||
         (inside && inside->offset == 0) || (space && space->offset == 0);
}

double* offset_of(SourceSpec& spec) {
  return std::visit(
      [](auto& source) -> double* {
        if constexpr (requires { source.offset; }) return &source.offset;
        return nullptr;
      },
      spec);
}

Result<SourceSpec> parse_source(std::string_view text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string_view::npos) return parse_plain(text);
  auto spec = parse_plain(text.substr(0, at));
  if (!spec) return spec;
  double* offset = offset_of(*spec);
  if (offset == nullptr) {
    return unreadable(quoted(text) + ": a curve has no offset",
                      {"give the offsets of points, as in 17@0.5"});
  }
  const auto number = number_in<double>(text.substr(at + 1));
  if (!number || !std::isfinite(*number) || *number < 0) {
    return unreadable(quoted(text) + ": " + quoted(text.substr(at + 1)) + " is no offset",
                      {"write a distance in model units, 0 or more, as in 17@0.5"});
  }
  *offset = *number == 0 ? 0.0 : *number;  // no minus zero
  return spec;
}

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
    const bool is_point =
        word.starts_with("face:") || word.starts_with("xyz:") || word.starts_with("sample:");
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
                   source.where + ": not a vertex id",
                   {"a curve joins vertices, one id a line"}};
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
                 one_line(path) + ": is a folder",
                 {"give a file with one vertex id or point a line"}};
  }
  const auto file = io::FileBytes::read(path);
  if (!file) {
    return with_hint(file.error(), {"give a file with one vertex id or point a line"});
  }
  const std::string shown = one_line(path);
  std::string_view rest = file->bytes();
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
    return Error{
        ErrorCode::kBadFile, shown + ": holds no source", {"write one vertex id or point a line"}};
  }
  if (!curve) return sources;
  return as_curve(shown, sources, lines);
}

}  // namespace geotherm::app
