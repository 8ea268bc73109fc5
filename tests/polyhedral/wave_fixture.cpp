// SPDX-License-Identifier: MIT
#include "tests/polyhedral/wave_fixture.h"

#include <algorithm>
#include <cmath>

namespace geotherm::test {

std::shared_ptr<const DistanceMethod> method_of(const MeshPtr& mesh, MethodKind kind, int threads) {
  MethodOptions options;
  options.method = kind;
  options.threads = threads;
  auto method = build_method(mesh, options);
  EXPECT_TRUE(method) << method.error().message;
  return method ? *method : nullptr;
}

DistanceResult solve(const DistanceMethod& method, const SourceSet& sources,
                     const QueryOptions& query) {
  auto result = method.solve(sources, query);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *std::move(result) : DistanceResult{};
}

std::vector<double> distances(const MeshPtr& mesh, MethodKind kind, const SourceSet& sources) {
  return solve(*method_of(mesh, kind), sources).distances;
}

ErrorPercent errors(std::span<const double> d, std::span<const double> exact) {
  if (d.size() != exact.size()) return {kUnreached, kUnreached};
  ErrorPercent out;
  double range = 0;
  int count = 0;
  for (std::size_t v = 0; v < exact.size(); ++v) {
    if (std::isfinite(d[v]) != std::isfinite(exact[v])) return {kUnreached, kUnreached};
    if (!std::isfinite(exact[v])) continue;
    const double error = std::abs(d[v] - exact[v]);
    range = std::max(range, exact[v]);
    out.largest = std::max(out.largest, error);
    if (exact[v] <= 0) continue;
    out.mean += error / exact[v];
    ++count;
  }
  if (count == 0) return {};
  return {100 * out.mean / count, 100 * out.largest / range};
}

std::string kind_name(MethodKind kind) {
  std::string name = to_text(kind);
  std::ranges::replace(name, '-', '_');
  return name;
}

}  // namespace geotherm::test
