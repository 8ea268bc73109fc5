// SPDX-License-Identifier: MIT
// The group of the nearest source, carried along with its wave.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/compare.h"

namespace geotherm::test {
namespace {

constexpr QueryOptions kWithLabels = {.quality = false, .fields = false, .nearest = true};
// Sources nearer to each other than this, in shares of the range, may be confused by a method's
// error.
constexpr double kUndecided = 0.01;
constexpr double kUndecidedFirstOrder = 0.06;

class Labels : public MethodOnMesh {
 protected:
  std::vector<Index> sources = {2, mesh->vertex_count() / 3, mesh->vertex_count() / 2,
                                mesh->vertex_count() - 3};
};

TEST_P(Labels, NameTheSourceThatIsNearestAlone) {
  std::vector<std::vector<double>> alone;
  double range = 0;
  for (const Index s : sources) {
    alone.push_back(solve(*method, SourceSet::of_vertices({s})).distances);
    range = std::max(range, largest(alone.back()));
  }
  const auto labels = solve(*method, SourceSet::of_vertices(sources), kWithLabels).nearest_source;
  ASSERT_EQ(static_cast<Index>(labels.size()), mesh->vertex_count());
  const double undecided =
      range * (kind == MethodKind::kFastMarching ? kUndecidedFirstOrder : kUndecided);
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    double least = kUnreached;
    for (const auto& d : alone) least = std::min(least, d[v]);
    ASSERT_GE(labels[v], 0) << "vertex " << v;
    EXPECT_LE(alone[static_cast<std::size_t>(labels[v])][v], least + undecided) << "vertex " << v;
  }
}

TEST_P(Labels, DoNotChangeTheDistances) {
  const SourceSet set = SourceSet::of_vertices(sources);
  EXPECT_EQ(solve(*method, set, kWithLabels).distances, solve(*method, set).distances);
}

INSTANTIATE_TEST_SUITE_P(Zoo, Labels,
                         testing::Combine(testing::ValuesIn(zoo(kSmooth)),
                                          testing::ValuesIn(kWaveKinds)),
                         name_and_kind);

/// The way to vertex 4 crosses an edge between two sources' realms beside its far end, where the
/// nearest sample is the other source's.
TEST(LabelsOnFewFaces, AreThoseOfWhereTheWayCrosses) {
  Draft draft;
  draft.positions = {{-0.9959, -0.0812, 0}, {0.8987, 0.4372, 0},  {-0.7063, -0.7068, 0},
                     {0.6552, 0.7542, 0},   {-0.9988, 0.0397, 0}, {-0.9227, -0.3842, 0}};
  draft.faces = {{3, 2, 1}, {0, 3, 4}, {3, 0, 2}, {0, 5, 2}};
  const MeshPtr few = finish(draft);
  for (const MethodKind kind : kRoundWaves) {
    const auto answer =
        solve(*method_of(few, kind), SourceSet::of_vertices({3, 2, 1}), kWithLabels);
    EXPECT_EQ(answer.nearest_source, (std::vector<Index>{1, 2, 1, 0, 1, 1})) << kind_name(kind);
  }
}

class LabelGroups : public testing::TestWithParam<MethodKind> {};

TEST_P(LabelGroups, HaveOneNumberForAConnectedCurve) {
  constexpr Index kN = 10;
  const MeshPtr mesh = finish(plane_grid(kN, kN, 1, 1));
  SourceSet set = SourceSet::of_vertices({grid_vertex(kN, 5, kN)});
  for (Index i = 0; i < kN; ++i) {
    set.edges.push_back({grid_vertex(kN, i, 0), grid_vertex(kN, i + 1, 0)});
  }
  const auto labels = solve(*method_of(mesh, GetParam()), set, kWithLabels).nearest_source;
  for (Index i = 0; i <= kN; ++i) {
    EXPECT_EQ(labels[grid_vertex(kN, i, 0)], 1);
    EXPECT_EQ(labels[grid_vertex(kN, i, 2)], 1);
  }
  EXPECT_EQ(labels[grid_vertex(kN, 5, kN)], 0);
  EXPECT_EQ(labels[grid_vertex(kN, 4, kN - 2)], 0);
}

TEST_P(LabelGroups, AreNoneWhereNoSourceCanBe) {
  for (const ZooMesh& each : zoo(kManifold | kClosed)) {
    if (std::string(each.name) != "two_components") continue;
    const MeshPtr mesh = each.mesh();
    const auto result =
        solve(*method_of(mesh, GetParam()), SourceSet::of_vertices({0}), kWithLabels);
    int unreached = 0;
    for (std::size_t v = 0; v < result.distances.size(); ++v) {
      EXPECT_EQ(result.nearest_source[v], std::isfinite(result.distances[v]) ? 0 : kNoIndex);
      unreached += std::isfinite(result.distances[v]) ? 0 : 1;
    }
    EXPECT_GT(unreached, 0);
  }
}

TEST_P(LabelGroups, AreLeftOutUnlessAskedFor) {
  const auto method = method_of(finish(sphere(2)), GetParam());
  EXPECT_TRUE(solve(*method, SourceSet::of_vertices({0})).nearest_source.empty());
}

INSTANTIATE_TEST_SUITE_P(Methods, LabelGroups, testing::ValuesIn(kWaveKinds),
                         [](const auto& each) { return kind_name(each.param); });

}  // namespace
}  // namespace geotherm::test
