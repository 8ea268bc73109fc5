// SPDX-License-Identifier: MIT
// What makes a distance one, up to a method's error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/compare.h"

namespace geotherm::test {
namespace {

// Shares of the largest distance on meshes of some twenty edges. Measured 0.002, 0.001, 0.02.
const std::map<MethodKind, double> kError = {{MethodKind::kWavefront, 0.006},
                                             {MethodKind::kWavefrontFine, 0.003},
                                             {MethodKind::kFastMarching, 0.05}};

class WaveMetric : public MethodOnMesh {
 protected:
  std::vector<Index> some = {1, mesh->vertex_count() / 4, mesh->vertex_count() / 2,
                             2 * mesh->vertex_count() / 3, mesh->vertex_count() - 2};

  std::vector<double> from(const std::vector<Index>& sources) const {
    return solve(*method, SourceSet::of_vertices(sources)).distances;
  }
};

TEST_P(WaveMetric, IsSymmetric) {
  std::vector<std::vector<double>> d;
  for (const Index a : some) d.push_back(from({a}));
  for (std::size_t i = 0; i < some.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR(d[i][some[j]], d[j][some[i]], kError.at(kind) * largest(d[i]));
    }
  }
}

TEST_P(WaveMetric, SatisfiesTheTriangleInequality) {
  const auto d0 = from({some[0]}), d1 = from({some[2]});
  const double tolerance = kError.at(kind) * largest(d0);
  for (std::size_t v = 0; v < d0.size(); ++v) EXPECT_LE(d0[v], d0[some[2]] + d1[v] + tolerance);
}

TEST_P(WaveMetric, ToSeveralSourcesIsThatToTheNearest) {
  std::vector<double> nearest(static_cast<std::size_t>(mesh->vertex_count()), kUnreached);
  for (const Index s : some) {
    const auto d = from({s});
    for (std::size_t v = 0; v < d.size(); ++v) nearest[v] = std::min(nearest[v], d[v]);
  }
  const double range = largest(from({some[0]}));
  const auto together = from(some);
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    EXPECT_NEAR(together[v], nearest[v], kError.at(kind) * range) << "vertex " << v;
  }
}

TEST_P(WaveMetric, IsBoundedByTheLengthOfEdges) {
  const auto d = from({some[1]});
  // A fall that is too small to be noticed is not passed on: a share of 1e-4 of an edge each time.
  constexpr double kNotNoticed = 1e-3;
  // Edges that were flipped away are none of the triangulation that fast marching walks over.
  const double error = kind == MethodKind::kFastMarching ? kError.at(kind) * largest(d) : 0.0;
  for (const Face& face : mesh->faces()) {
    for (int k = 0; k < 3; ++k) {
      const Index a = face[k], b = face[(k + 1) % 3];
      const double edge = (mesh->positions()[a] - mesh->positions()[b]).norm();
      EXPECT_LE(std::abs(d[a] - d[b]), edge * (1 + kNotNoticed) + error);
    }
  }
}

TEST_P(WaveMetric, DoesNotDependOnTheOrderOfSources) {
  std::vector<Index> reversed(some.rbegin(), some.rend());
  reversed.push_back(some[0]);  // nor on naming one twice
  EXPECT_EQ(from(reversed), from(some));
}

INSTANTIATE_TEST_SUITE_P(Zoo, WaveMetric,
                         testing::Combine(testing::ValuesIn(zoo(kSmooth)),
                                          testing::ValuesIn(kWaveKinds)),
                         name_and_kind);

}  // namespace
}  // namespace geotherm::test
