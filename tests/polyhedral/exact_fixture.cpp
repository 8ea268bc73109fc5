// SPDX-License-Identifier: MIT
#include "tests/polyhedral/exact_fixture.h"

namespace geotherm::test {

std::shared_ptr<const ExactMethod> exact_method(const MeshPtr& mesh, int threads) {
  auto surface = build_wave_surface(mesh);
  EXPECT_TRUE(surface) << surface.error().message;
  if (!surface) return nullptr;
  auto method = ExactMethod::build(*std::move(surface), threads);
  EXPECT_TRUE(method) << method.error().message;
  return method ? *std::move(method) : nullptr;
}

DistanceResult solve_exactly(const ExactMethod& method, const SourceSet& sources,
                             const QueryOptions& query) {
  auto result = method.solve(sources, query);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *std::move(result) : DistanceResult{};
}

std::vector<double> exact_distances(const MeshPtr& mesh, const SourceSet& sources) {
  const auto method = exact_method(mesh);
  return method ? solve_exactly(*method, sources).distances : std::vector<double>();
}

std::vector<double> exact_distances(const MeshPtr& mesh, const std::vector<Index>& sources) {
  return exact_distances(mesh, SourceSet::of_vertices(sources));
}

}  // namespace geotherm::test
