// SPDX-License-Identifier: MIT
#include "app/source_spec.h"

#include <cmath>
#include <span>

#include "app/text.h"

namespace geotherm::app {
namespace {

/// Weights are accepted when they sum to 1 within this (0.333:0.333:0.334 and the like), and are
/// then divided by their sum.
constexpr double kWeightSum = 1e-3;

Error bad(std::string message) { return {ErrorCode::kBadInput, std::move(message)}; }

std::string quoted(std::string_view text) { return "'" + one_line(std::string(text)) + "'"; }

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(at, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

Result<std::array<double, 3>> three_numbers(std::span<const std::string_view> parts) {
  std::array<double, 3> numbers{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = number_in<double>(parts[k]);
    if (!number || !std::isfinite(*number)) {
      return bad(quoted(parts[k]) + " is no finite number; write one such as -1.5 or 2e-3");
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
      return bad(quoted(text) +
                 " is no source; write vertex ids from 0 (17 or 3,99,512), random:K[:SEED], "
                 "boundary, face:ID:b0:b1:b2 or xyz:x:y:z");
    }
    list.vertices.push_back(*vertex);
  }
  return SourceSpec(std::move(list));
}

Result<SourceSpec> parse_random(std::string_view text, const std::vector<std::string_view>& parts) {
  RandomVertices random;
  const auto count = parts.size() > 1 ? number_in<Index>(parts[1]) : std::nullopt;
  const auto seed = parts.size() == 3 ? number_in<std::uint64_t>(parts[2]) : random.seed;
  if (!count || !seed || parts.size() > 3) {
    return bad(quoted(text) +
               " does not say how many vertices; write random:K or random:K:SEED, both whole "
               "numbers");
  }
  if (*count < 1)
    return bad("random:" + std::to_string(*count) + " asks for no vertex; give 1 or more");
  return SourceSpec(RandomVertices{*count, *seed});
}

Result<SourceSpec> parse_face(std::string_view text, const std::vector<std::string_view>& parts) {
  const auto face = parts.size() == 5 ? number_in<Index>(parts[1]) : std::nullopt;
  if (!face || *face < 0) {
    return bad(quoted(text) +
               " is no point in a face; write face:ID:b0:b1:b2, with the weights of its corners");
  }
  auto weights = three_numbers(std::span(parts).subspan(2));
  if (!weights) return bad(quoted(text) + ": " + weights.error().message);
  double sum = 0;
  for (const double w : *weights) {
    if (w < 0) {
      return bad(quoted(text) + ": the weight " + significant(w) +
                 " is negative; barycentric weights are not, and sum to 1");
    }
    sum += w;
  }
  if (std::abs(sum - 1) > kWeightSum) {
    return bad(quoted(text) + ": the weights sum to " + significant(sum) +
               "; barycentric weights are not negative and sum to 1");
  }
  for (double& w : *weights) w /= sum;
  return SourceSpec(FacePoint{*face, *weights});
}

}  // namespace

Result<SourceSpec> parse_space_point(const std::array<std::string_view, 3>& numbers) {
  const auto values = three_numbers(numbers);
  if (!values) return values.error();
  return SourceSpec(SpacePoint{Vec3((*values)[0], (*values)[1], (*values)[2])});
}

Result<SourceSpec> parse_source(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (text == "boundary") return SourceSpec(WholeBoundary{});
  if (parts[0] == "random") return parse_random(text, parts);
  if (parts[0] == "face") return parse_face(text, parts);
  if (parts[0] == "xyz") {
    if (parts.size() != 4) {
      return bad(quoted(text) + " is no point in space; write xyz:x:y:z, in model units");
    }
    auto point = parse_space_point({parts[1], parts[2], parts[3]});
    if (!point) return bad(quoted(text) + ": " + point.error().message);
    return point;
  }
  return parse_vertices(text);
}

}  // namespace geotherm::app
