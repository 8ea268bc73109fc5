// SPDX-License-Identifier: MIT
#include "geotherm/distance_method.h"

#include <array>
#include <utility>

namespace geotherm {
namespace {

constexpr std::array<std::pair<MethodKind, std::string_view>, 5> kMethods = {{
    {MethodKind::kHeat, "heat"},
    {MethodKind::kWavefront, "wavefront"},
    {MethodKind::kWavefrontFine, "wavefront-fine"},
    {MethodKind::kFastMarching, "fast-marching"},
    {MethodKind::kExact, "exact"},
}};

}  // namespace

std::string to_text(MethodKind kind) {
  for (const auto& [value, name] : kMethods) {
    if (value == kind) return std::string(name);
  }
  return {};
}

Result<MethodKind> parse_method(std::string_view text) {
  std::string names;
  for (const auto& [value, name] : kMethods) {
    if (name == text) return value;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return Error{ErrorCode::kNotAvailable,
               "there is no method '" + std::string(text) + "'",
               {"there are " + names}};
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const auto& [value, name] : kMethods) names.emplace_back(name);
  return names;
}

Result<DistanceResult> DistanceMethod::solve(const SourceSet& sources, const QueryOptions& query,
                                             const Progress& progress) const {
  auto results = solve_each({&sources, 1}, query, progress);
  if (!results) return results.error();
  return std::move(results->front());
}

}  // namespace geotherm
