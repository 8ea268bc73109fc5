// SPDX-License-Identifier: MIT
// What makes a distance one, up to the error of the discretisation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// The method's error is of the order of an edge; two distances are compared.
constexpr double kEdges = 2;

class Metric : public testing::TestWithParam<ZooMesh> {
 protected:
  MeshPtr mesh = GetParam().mesh();
  HeatMethod method = method_of(mesh);
  double tolerance = kEdges * std::sqrt(method.t());  // t is the square of the mean edge
  std::vector<Index> some = {1, mesh->vertex_count() / 4, mesh->vertex_count() / 2,
                             2 * mesh->vertex_count() / 3, mesh->vertex_count() - 2};

  std::vector<double> from(const std::vector<Index>& sources) const {
    return solve(method, SourceSet::of_vertices(sources)).distances;
  }
};

TEST_P(Metric, IsSymmetric) {
  for (const Index a : some) {
    const auto d = from({a});
    for (const Index b : some) {
      EXPECT_NEAR(d[b], from({b})[a], tolerance) << a << " and " << b;
    }
  }
}

TEST_P(Metric, SatisfiesTheTriangleInequality) {
  const auto d0 = from({some[0]});
  for (const Index middle : some) {
    const auto d1 = from({middle});
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      EXPECT_LE(d0[v], d0[middle] + d1[v] + tolerance) << "vertex " << v;
    }
  }
}

TEST_P(Metric, ToSeveralSourcesIsThatToTheNearest) {
  std::vector<double> nearest(static_cast<std::size_t>(mesh->vertex_count()), kUnreached);
  for (const Index s : some) {
    const auto d = from({s});
    for (std::size_t v = 0; v < d.size(); ++v) nearest[v] = std::min(nearest[v], d[v]);
  }
  const auto together = from(some);
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    EXPECT_NEAR(together[v], nearest[v], tolerance) << "vertex " << v;
  }
}

TEST_P(Metric, IsBoundedByTheLengthOfEdges) {
  const auto d = from({some[1]});
  for (const Face& face : mesh->faces()) {
    for (int k = 0; k < 3; ++k) {
      const Index a = face[k], b = face[(k + 1) % 3];
      const double edge = (mesh->positions()[a] - mesh->positions()[b]).norm();
      EXPECT_LE(std::abs(d[a] - d[b]), edge + tolerance);
    }
  }
}

TEST_P(Metric, DoesNotDependOnTheOrderOfSources) {
  std::vector<Index> reversed(some.rbegin(), some.rend());
  reversed.push_back(some[0]);  // nor on naming one twice
  EXPECT_EQ(from(reversed), from(some));
}

INSTANTIATE_TEST_SUITE_P(Zoo, Metric, testing::ValuesIn(zoo(kSmooth)), zoo_name);

}  // namespace
}  // namespace geotherm::test
